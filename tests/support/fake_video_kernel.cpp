#include "tests/support/fake_video_kernel.h"

#include <sys/eventfd.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace instep::test {
namespace {

constexpr std::uint32_t kBytesPerPixel = 2;
constexpr std::uint8_t kNoDepth = 0xEE;
/// Buffer i is mapped at this times i + 1.
constexpr std::uint32_t kOffsetStep = 1U << 24U;

int refuse(int error) {
  errno = error;
  return -1;
}

std::chrono::microseconds monotonic_now() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now().time_since_epoch());
}

/// The eventfd that stands for a device wakes whoever polls it.
void wake(int descriptor) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(descriptor, &one, sizeof one);
}

std::uint32_t planes(std::uint32_t code) {
  return code == V4L2_PIX_FMT_INZI ? 2 : 1;
}

void paint(const v4l2_pix_format& format, std::uint32_t padding, std::uint32_t sequence,
           std::vector<std::uint8_t>& memory) {
  std::fill(memory.begin(), memory.end(), kNoDepth);
  const std::size_t row_bytes = kBytesPerPixel * format.width + padding;
  const std::size_t begin = (planes(format.pixelformat) - 1) * row_bytes * format.height;
  for (std::size_t y = 0; y < format.height; ++y) {
    for (std::size_t x = 0; x < format.width; ++x) {
      const std::size_t value = y * format.width + x + sequence;
      const std::size_t at = begin + y * row_bytes + kBytesPerPixel * x;
      if (at + 1 >= memory.size()) return;
      memory[at] = static_cast<std::uint8_t>(value & 0xFF);
      memory[at + 1] = static_cast<std::uint8_t>(value >> 8 & 0xFF);
    }
  }
}

}  // namespace

bool FakeVideoKernel::Node::is_mapped() const {
  return std::any_of(buffers.begin(), buffers.end(), [](const auto& one) { return one->mapped; });
}

void FakeVideoKernel::add(const std::string& path, FakeVideoDevice device) {
  const std::lock_guard lock(mutex_);
  auto node = std::make_shared<Node>();
  node->device = std::move(device);
  nodes_[path] = std::move(node);
}

void FakeVideoKernel::remove(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto node = nodes_.at(path);
  nodes_.erase(path);
  node->gone = true;
  for (const auto& [descriptor, opened] : open_) {
    if (opened == node) wake(descriptor);
  }
}

void FakeVideoKernel::fail_call(int k, int error) {
  const std::lock_guard lock(mutex_);
  failing_call_ = calls_ + k;
  failure_ = error;
}

int FakeVideoKernel::calls() const {
  const std::lock_guard lock(mutex_);
  return calls_;
}

int FakeVideoKernel::held() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(open_.size() + mappings_.size());
}

int FakeVideoKernel::misuses() const {
  const std::lock_guard lock(mutex_);
  return misuses_;
}

bool FakeVideoKernel::fails_now() {
  if (++calls_ != failing_call_) return false;
  errno = failure_;
  return true;
}

int FakeVideoKernel::open(const char* path, int) {
  const std::lock_guard lock(mutex_);
  if (fails_now()) return -1;
  const auto node = nodes_.find(path);
  if (node == nodes_.end()) return refuse(ENOENT);
  const int descriptor = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  open_[descriptor] = node->second;
  return descriptor;
}

int FakeVideoKernel::close(int descriptor) {
  const std::lock_guard lock(mutex_);
  const auto found = open_.find(descriptor);
  if (found == open_.end()) {
    ++misuses_;
    return refuse(EBADF);
  }
  // As in the kernel, the buffers go with the descriptor, but not what is mapped of them.
  Node& node = *found->second;
  if (node.owner == descriptor) {
    node.streaming = false;
    node.queue.clear();
    node.done.clear();
    if (!node.is_mapped()) {
      node.buffers.clear();
      node.owner = -1;
    }
  }
  open_.erase(found);
  const bool failed = fails_now();
  return ::close(descriptor) != 0 || failed ? -1 : 0;
}

int FakeVideoKernel::control(int descriptor, unsigned long request, void* argument) {
  const std::lock_guard lock(mutex_);
  const auto found = open_.find(descriptor);
  if (found == open_.end()) {
    ++misuses_;
    return refuse(EBADF);
  }
  if (fails_now()) return -1;
  if (found->second->gone) return refuse(ENODEV);
  return answer(*found->second, descriptor, request, argument);
}

int FakeVideoKernel::answer(Node& node, int descriptor, unsigned long request, void* argument) {
  const bool is_owner = node.owner == descriptor;
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& capability = *static_cast<v4l2_capability*>(argument);
      capability.device_caps = node.device.capabilities;
      capability.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      return 0;
    }
    case VIDIOC_ENUM_FMT: {
      auto& format = *static_cast<v4l2_fmtdesc*>(argument);
      if (format.index >= node.device.formats.size()) return refuse(EINVAL);
      format.pixelformat = node.device.formats[format.index];
      return 0;
    }
    case VIDIOC_ENUM_FRAMESIZES: {
      auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
      if (size.index >= node.device.sizes.size()) return refuse(EINVAL);
      size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      size.discrete = node.device.sizes[size.index];
      return 0;
    }
    case VIDIOC_S_FMT:
      return node.owner >= 0 ? refuse(EBUSY)
                             : set_format(node, *static_cast<v4l2_format*>(argument));
    case VIDIOC_QUERYCTRL:
      return query_control(node, *static_cast<v4l2_queryctrl*>(argument));
    case VIDIOC_S_CTRL:
      return set_control(node, *static_cast<v4l2_control*>(argument));
    case VIDIOC_G_CTRL: {
      auto& control = *static_cast<v4l2_control*>(argument);
      control.value = node.device.controls.at(control.id - 1).value;
      return 0;
    }
    case VIDIOC_REQBUFS:
      return request_buffers(node, descriptor, *static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      if (!is_owner || buffer.index >= node.buffers.size()) return refuse(EINVAL);
      buffer.length = static_cast<std::uint32_t>(node.buffers[buffer.index]->memory.size());
      buffer.m.offset = (buffer.index + 1) * kOffsetStep;
      return 0;
    }
    case VIDIOC_QBUF:
      return is_owner ? take_back(node, *static_cast<v4l2_buffer*>(argument)) : refuse(EBUSY);
    case VIDIOC_DQBUF:
      return is_owner ? give(node, *static_cast<v4l2_buffer*>(argument)) : refuse(EBUSY);
    case VIDIOC_STREAMON:
      if (!is_owner || node.queue.empty()) return refuse(EINVAL);
      if (node.device.stream_on_error != 0) return refuse(node.device.stream_on_error);
      node.streaming = true;
      node.sequence = 0;
      return 0;
    case VIDIOC_STREAMOFF:
      if (!is_owner) return refuse(EBUSY);
      node.streaming = false;
      node.queue.clear();
      node.done.clear();
      for (const auto& buffer : node.buffers) buffer->where = Where::kProgram;
      return 0;
    default:
      return refuse(ENOTTY);
  }
}

int FakeVideoKernel::set_format(Node& node, v4l2_format& format) {
  auto& pix = format.fmt.pix;
  const FakeVideoDevice& device = node.device;
  pix.pixelformat = device.other_code.value_or(pix.pixelformat);
  pix.width = device.other_width.value_or(pix.width);
  pix.bytesperline = planes(pix.pixelformat) * kBytesPerPixel * pix.width + device.padding;
  pix.sizeimage = device.other_image_size.value_or(pix.bytesperline * pix.height);
  pix.bytesperline = device.other_line.value_or(pix.bytesperline);
  node.format = format;
  return 0;
}

int FakeVideoKernel::request_buffers(Node& node, int descriptor, v4l2_requestbuffers& request) {
  if (node.owner >= 0 && node.owner != descriptor) return refuse(EBUSY);
  if (node.streaming || node.is_mapped()) return refuse(EBUSY);
  node.buffers.clear();
  node.owner = -1;
  if (request.count == 0) return 0;
  request.count = std::min(request.count, node.device.buffers);
  for (std::uint32_t i = 0; i < request.count; ++i) {
    node.buffers.push_back(std::make_unique<Buffer>());
    node.buffers.back()->memory.resize(node.format.fmt.pix.sizeimage);
  }
  node.owner = descriptor;
  return 0;
}

/// QBUF. Queuing what the kernel has already is the mistake behind V5.
int FakeVideoKernel::take_back(Node& node, v4l2_buffer& buffer) {
  if (buffer.index >= node.buffers.size() || node.buffers[buffer.index]->where != Where::kProgram) {
    ++misuses_;
    return refuse(EINVAL);
  }
  node.buffers[buffer.index]->where = Where::kQueue;
  node.queue.push_back(buffer.index);
  return 0;
}

int FakeVideoKernel::give(Node& node, v4l2_buffer& buffer) {
  if (!node.streaming) return refuse(EINVAL);
  if (node.done.empty()) return refuse(EAGAIN);
  const std::size_t index = node.done.front();
  node.done.pop_front();
  node.buffers[index]->where = Where::kProgram;
  buffer = node.buffers[index]->filled;
  return 0;
}

int FakeVideoKernel::query_control(const Node& node, v4l2_queryctrl& query) {
  const std::uint32_t next = query.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;  // ids are 1, 2, 3, ...
  if (next >= node.device.controls.size()) return refuse(EINVAL);
  const auto& control = node.device.controls[next];
  query = {};
  query.id = next + 1;
  query.minimum = control.minimum;
  query.maximum = control.maximum;
  query.step = control.step;
  std::strncpy(reinterpret_cast<char*>(query.name), control.name.c_str(), sizeof query.name - 1);
  return 0;
}

int FakeVideoKernel::set_control(Node& node, v4l2_control& control) {
  auto& known = node.device.controls.at(control.id - 1);
  const bool locked = std::any_of(
      node.device.controls.begin(), node.device.controls.end(),
      [&](const auto& other) { return other.name == known.locked_by && other.value != 1; });
  if (!locked) known.value = control.value / known.step * known.step;
  return 0;
}

void* FakeVideoKernel::map(std::size_t length, int descriptor, off_t offset) {
  const std::lock_guard lock(mutex_);
  const auto failed = [](int error) {
    errno = error;
    return MAP_FAILED;
  };
  if (fails_now()) return MAP_FAILED;
  const auto found = open_.find(descriptor);
  if (found == open_.end()) return failed(EBADF);
  if (found->second->gone) return failed(ENODEV);
  const auto index = static_cast<std::size_t>(offset / kOffsetStep) - 1;
  if (index >= found->second->buffers.size()) return failed(EINVAL);
  Buffer& buffer = *found->second->buffers[index];
  if (length != buffer.memory.size()) return failed(EINVAL);
  buffer.mapped = true;
  mappings_[buffer.memory.data()] = found->second;
  return buffer.memory.data();
}

int FakeVideoKernel::unmap(void* memory, std::size_t) {
  const std::lock_guard lock(mutex_);
  const auto found = mappings_.find(memory);
  if (found == mappings_.end()) {
    ++misuses_;
    return refuse(EINVAL);
  }
  Node& node = *found->second;
  for (const auto& buffer : node.buffers) {
    if (buffer->memory.data() == memory) buffer->mapped = false;
  }
  // A mapping keeps the file alive behind a closed descriptor.
  if (!node.is_mapped() && open_.count(node.owner) == 0) {
    node.buffers.clear();
    node.owner = -1;
  }
  mappings_.erase(found);
  return fails_now() ? -1 : 0;
}

void FakeVideoKernel::produce(Node& node) {
  if (node.queue.empty() || (node.device.silent && node.device.images.empty())) return;
  FakeVideoDevice::Image image;
  if (!node.device.images.empty()) {
    image = node.device.images.front();
    node.device.images.pop_front();
  }
  node.sequence += image.lost_before;
  const std::uint32_t sequence = image.sequence.value_or(node.sequence++);
  const std::size_t index = node.queue.front();
  node.queue.pop_front();
  Buffer& buffer = *node.buffers[index];
  paint(node.format.fmt.pix, node.device.padding, sequence, buffer.memory);
  buffer.where = Where::kDone;
  v4l2_buffer& filled = buffer.filled;
  filled = {};
  filled.index = static_cast<std::uint32_t>(index);
  filled.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  filled.memory = V4L2_MEMORY_MMAP;
  filled.sequence = sequence;
  filled.flags = image.clock | (image.flagged ? V4L2_BUF_FLAG_ERROR : 0U);
  filled.bytesused = image.bytes.value_or(node.format.fmt.pix.sizeimage);
  const auto stamp = image.stamp.value_or(monotonic_now());
  filled.timestamp.tv_sec = stamp.count() / 1000000;
  filled.timestamp.tv_usec = stamp.count() % 1000000;
  node.done.push_back(index);
}

short FakeVideoKernel::state_of(Node& node) {
  if (node.gone) return POLLERR | POLLHUP;
  if (!node.streaming) return POLLERR;
  if (node.done.empty()) produce(node);
  return node.done.empty() ? 0 : POLLIN;
}

int FakeVideoKernel::poll(pollfd* waiting, nfds_t count, int timeout_ms) {
  const auto look = [&] {
    int ready = 0;
    for (nfds_t i = 0; i < count; ++i) {
      const auto node = open_.find(waiting[i].fd);
      if (node != open_.end()) waiting[i].revents = state_of(*node->second);
      ready += waiting[i].revents != 0 ? 1 : 0;
    }
    return ready;
  };
  {
    const std::lock_guard lock(mutex_);
    if (fails_now()) return -1;
    // Only whether the others are ready counts here; the devices' eventfds say that something
    // happened, not what.
    if (::poll(waiting, count, 0) < 0) return -1;
    if (const int ready = look(); ready > 0) return ready;
  }
  if (::poll(waiting, count, timeout_ms) < 0) return -1;
  const std::lock_guard lock(mutex_);
  return look();
}

}  // namespace instep::test
