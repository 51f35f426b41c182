#include "tests/kernel/devices/usb_depth_camera.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "drivers/files/descriptor.h"
#include "tests/kernel/devices/uvc_descriptors.h"

namespace instep::test {
namespace {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

// USB/IP, as the kernel's Documentation/usb/usbip_protocol.rst has it: headers of 12 big-endian
// words, the last two of a request being the setup packet of a control transfer.
constexpr std::size_t kWords = 12;
using Header = std::array<std::uint32_t, kWords>;
constexpr std::uint32_t kSubmit = 1;
constexpr std::uint32_t kUnlink = 2;
constexpr std::uint32_t kSubmitted = 3;
constexpr std::uint32_t kUnlinked = 4;
constexpr std::uint32_t kHighSpeed = 3;

constexpr std::uint8_t kSetConfiguration = 9;

constexpr std::uint8_t kLastOfFrame = 0x02;  // bits of a UVC payload header
constexpr std::uint8_t kDamaged = 0x40;
constexpr std::uint8_t kEndOfHeader = 0x80;

bool receive(int socket, void* memory, std::size_t count) {
  auto* place = static_cast<std::uint8_t*>(memory);
  while (count > 0) {
    const ssize_t got = ::recv(socket, place, count, 0);
    if (got <= 0) return false;
    place += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

void send(int socket, const Bytes& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t now = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now <= 0) return;  // unplugged: the reader finds out
    sent += static_cast<std::size_t>(now);
  }
}

/// Whether the kernel has a device at that port of its virtual controller.
bool is_in_socket(int port) {
  const auto ending = std::string("-").append(std::to_string(port + 1));
  std::error_code gone;  // as it may be by now
  for (const auto& bus : std::filesystem::directory_iterator("/sys/bus/usb/devices")) {
    const auto place = std::filesystem::read_symlink(bus.path(), gone).string();
    if (place.find("vhci_hcd.0/") != std::string::npos && place.ends_with(ending)) return true;
  }
  return false;
}

/// The setup packet of a control transfer (USB 2.0, 9.3).
struct Setup {
  std::uint8_t kind;
  std::uint8_t request;
  std::uint16_t value;
  std::uint16_t index;
};

Setup setup_of(const std::uint8_t* bytes) {
  return {bytes[0], bytes[1], static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8),
          static_cast<std::uint16_t>(bytes[4] | bytes[5] << 8)};
}

UvcDescription description_of(const UsbDepthCamera::Settings& settings) {
  UvcDescription description;
  description.serial = settings.serial;
  description.four_letters = settings.four_letters;
  description.width = static_cast<std::uint32_t>(settings.width);
  description.height = static_cast<std::uint32_t>(settings.height);
  description.frames_per_second = static_cast<std::uint32_t>(settings.frames_per_second);
  description.usb_version = settings.usb_version;
  description.vendor = settings.vendor;
  return description;
}

}  // namespace

/// The camera's side of one cable, and what it streams.
class UsbDepthCamera::Device {
 public:
  Device(const Settings& chosen, Scene scene)
      : settings(chosen), uvc_(description_of(chosen)), scene_(std::move(scene)) {}

  /// Serves the cable until it is pulled.
  void serve(int socket) {
    waiting_.clear();
    frame_.clear();
    while (true) {
      pollfd readable{socket, POLLIN, 0};
      ::poll(&readable, 1, milliseconds_to_next_frame());
      if (readable.revents != 0 && !answer(socket)) return;
      const std::lock_guard lock(mutex);
      stream(socket);
    }
  }

  const Settings settings;
  std::thread thread;
  int cable = -1;  ///< our end of it; -1 = unplugged

  std::mutex mutex;  ///< guards what follows
  struct Faults {
    int flagged = 0;
    int shortened = 0;
    int stalled = 0;
    bool silent = false;
  } faults;
  std::uint32_t frames = 0;
  int set_ups = 0;

 private:
  /// A request of the host for stream data.
  struct Wanted {
    std::uint32_t number;
    std::uint32_t most_bytes;
  };

  int milliseconds_to_next_frame() const {
    if (waiting_.empty()) return -1;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(due_ - steady_clock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 1, 50));
  }

  /// Answers one message; false at the end of the connection.
  bool answer(int socket) {
    Header header{};
    if (!receive(socket, header.data(), sizeof header)) return false;
    const auto* setup = reinterpret_cast<const std::uint8_t*>(&header[10]);
    const auto word = [&](std::size_t i) { return ntohl(header[i]); };
    const std::uint32_t number = word(1);
    const bool to_host = word(3) == 1;
    const std::uint32_t endpoint = word(4);
    const std::uint32_t bytes = word(6);
    if (word(0) == kUnlink) {
      unlink(socket, number, word(5));
      return true;
    }
    if (word(0) != kSubmit) return false;
    Bytes sent(to_host ? 0 : bytes);
    if (!sent.empty() && !receive(socket, sent.data(), sent.size())) return false;
    const std::lock_guard lock(mutex);
    if (endpoint == 0) {
      control(socket, number, setup_of(setup), bytes, sent);
    } else {
      waiting_.push_back({number, bytes});
    }
    return true;
  }

  static void reply(int socket, std::uint32_t kind, std::uint32_t number, int status,
                    std::uint32_t actual_bytes, const Bytes& data) {
    Header header{};
    header[0] = htonl(kind);
    header[1] = htonl(number);
    header[5] = htonl(static_cast<std::uint32_t>(status));
    header[6] = htonl(actual_bytes);
    Bytes message(sizeof header);
    std::memcpy(message.data(), header.data(), sizeof header);
    message.insert(message.end(), data.begin(), data.end());
    send(socket, message);
  }

  void unlink(int socket, std::uint32_t number, std::uint32_t victim) {
    const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                    [&](const auto& one) { return one.number == victim; });
    const bool was_waiting = found != waiting_.end();
    if (was_waiting) waiting_.erase(found);
    reply(socket, kUnlinked, number, was_waiting ? -ECONNRESET : 0, 0, {});
  }

  void control(int socket, std::uint32_t number, const Setup& setup, std::uint32_t most_bytes,
               const Bytes& sent) {
    std::optional<Bytes> data = answer_to(setup);
    if (!data) return reply(socket, kSubmitted, number, -EPIPE, 0, {});  // a stall
    const bool to_host = (setup.kind & 0x80) != 0;
    if (data->size() > most_bytes) data->resize(most_bytes);
    const std::size_t actual = to_host ? data->size() : sent.size();
    reply(socket, kSubmitted, number, 0, static_cast<std::uint32_t>(actual), *data);
  }

  /// The data of a control transfer; nothing = a stall, which says no.
  std::optional<Bytes> answer_to(const Setup& setup) {
    switch (setup.kind) {
      case 0x80:  // from the device: GET_STATUS, GET_DESCRIPTOR
        return setup.request == 0 ? Bytes{0, 0} : descriptor(setup.value);
      case 0x00:  // to the device: SET_CONFIGURATION and others
        if (setup.request == kSetConfiguration) ++set_ups;
        return Bytes{};
      case 0x01:  // to an interface: SET_INTERFACE
      case 0x02:  // to an endpoint: CLEAR_FEATURE, by which uvcvideo ends a bulk stream
        frame_.clear();
        return Bytes{};
      case 0x21:
      case 0xA1:
        return video_request(setup);
      default:
        return std::nullopt;
    }
  }

  std::optional<Bytes> descriptor(std::uint16_t value) const {
    Bytes bytes;
    if (value >> 8 == 1) bytes = device_descriptor(uvc_);
    if (value >> 8 == 2) bytes = configuration_descriptor(uvc_);
    if (value >> 8 == 3) bytes = string_descriptor(uvc_, value & 0xFF);
    return bytes.empty() ? std::nullopt : std::optional(bytes);
  }

  /// The negotiation of the stream: whatever is proposed, the answer is the same.
  std::optional<Bytes> video_request(const Setup& setup) {
    constexpr std::uint8_t kSet = 0x01;
    constexpr std::uint8_t kGetLength = 0x85;
    constexpr std::uint8_t kGetAbilities = 0x86;
    const int selector = setup.value >> 8;
    const bool of_stream = (setup.index & 0xFF) == 1 && (selector == 1 || selector == 2);
    if (!of_stream) return std::nullopt;
    if (faults.stalled > 0) {
      --faults.stalled;
      return std::nullopt;
    }
    if (setup.request == kSet) {
      constexpr int kCommit = 2;
      if (selector == kCommit) due_ = steady_clock::now();
      return Bytes{};
    }
    const Bytes parameters = probe_parameters(uvc_);
    if (setup.request == kGetAbilities) return Bytes{3};
    if (setup.request == kGetLength) return Bytes{static_cast<std::uint8_t>(parameters.size()), 0};
    return parameters;
  }

  /// Sends what the host waits for and the camera has.
  void stream(int socket) {
    while (!waiting_.empty()) {
      if (frame_.empty() && !expose()) return;
      const Wanted wanted = waiting_.front();
      waiting_.pop_front();
      const Bytes payload = next_payload(std::min(wanted.most_bytes, kPayloadBytes));
      reply(socket, kSubmitted, wanted.number, 0, static_cast<std::uint32_t>(payload.size()),
            payload);
    }
  }

  /// Takes the next frame; false if it is not time yet.
  bool expose() {
    const auto now = steady_clock::now();
    if (faults.silent || now < due_) return false;
    const std::chrono::microseconds interval(1'000'000 / settings.frames_per_second);
    due_ = std::max(due_ + interval, now);
    const std::uint32_t number = frames++;
    for (const std::uint16_t depth : scene_(number)) append16(frame_, depth);
    if (faults.shortened > 0) {
      --faults.shortened;
      frame_.resize(frame_.size() / 2);
    }
    bits_ = static_cast<std::uint8_t>((bits_ ^ 1) & 1);  // tells one frame from the next
    if (faults.flagged > 0) {
      --faults.flagged;
      bits_ |= kDamaged;
    }
    sent_ = 0;
    return true;
  }

  Bytes next_payload(std::uint32_t most_bytes) {
    constexpr std::size_t kHeader = 2;
    const std::size_t count = std::min(most_bytes - kHeader, frame_.size() - sent_);
    const auto begin = frame_.begin() + static_cast<std::ptrdiff_t>(sent_);
    sent_ += count;
    const bool last = sent_ == frame_.size();
    const auto bits = static_cast<std::uint8_t>(kEndOfHeader | bits_ | (last ? kLastOfFrame : 0));
    Bytes payload{kHeader, bits};
    payload.insert(payload.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    if (last) frame_.clear();
    return payload;
  }

  const UvcDescription uvc_;
  const Scene scene_;
  std::deque<Wanted> waiting_;
  Bytes frame_;            ///< the one that is being sent; empty = none
  std::size_t sent_ = 0;   ///< of it
  std::uint8_t bits_ = 0;  ///< in the headers of its payloads
  steady_clock::time_point due_;
};

UsbDepthCamera::UsbDepthCamera(const Settings& settings, Scene scene)
    : device_(std::make_shared<Device>(settings, std::move(scene))) {}

UsbDepthCamera::~UsbDepthCamera() {
  unplug();
  // The kernel takes its nodes away in its own time; what comes next is to find none.
  const auto limit = steady_clock::now() + 10s;
  while (is_in_socket(device_->settings.port) && steady_clock::now() < limit) {
    std::this_thread::sleep_for(5ms);
  }
}

void UsbDepthCamera::plug() {
  unplug();
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error("no socket pair");
  }
  const Descriptor theirs(ends[1]);
  const int port = device_->settings.port;
  const std::string order = std::to_string(port) + " " + std::to_string(theirs.number()) + " " +
                            std::to_string(1 << 16 | (port + 2)) + " " + std::to_string(kHighSpeed);
  const Descriptor attach(::open("/sys/devices/platform/vhci_hcd.0/attach", O_WRONLY | O_CLOEXEC));
  if (::write(attach.number(), order.data(), order.size()) < 0) {
    ::close(ends[0]);
    throw std::runtime_error("vhci_hcd does not take the camera: " + std::string(strerror(errno)));
  }
  device_->cable = ends[0];
  device_->thread = std::thread([device = device_, cable = ends[0]] { device->serve(cable); });
}

void UsbDepthCamera::unplug() {
  if (device_->cable < 0) return;
  ::shutdown(device_->cable, SHUT_RDWR);
  device_->thread.join();
  ::close(std::exchange(device_->cable, -1));
}

void UsbDepthCamera::flag_frames(int count) {
  const std::lock_guard lock(device_->mutex);
  device_->faults.flagged = count;
}

void UsbDepthCamera::shorten_frames(int count) {
  const std::lock_guard lock(device_->mutex);
  device_->faults.shortened = count;
}

void UsbDepthCamera::fall_silent(bool silent) {
  const std::lock_guard lock(device_->mutex);
  device_->faults.silent = silent;
}

void UsbDepthCamera::stall_probes(int count) {
  const std::lock_guard lock(device_->mutex);
  device_->faults.stalled = count;
}

std::uint32_t UsbDepthCamera::frames_sent() const {
  const std::lock_guard lock(device_->mutex);
  return device_->frames;
}

int UsbDepthCamera::set_ups() const {
  const std::lock_guard lock(device_->mutex);
  return device_->set_ups;
}

std::string UsbDepthCamera::bus_path() const {
  return "usb-vhci_hcd.0-" + std::to_string(device_->settings.port + 1);
}

}  // namespace instep::test
