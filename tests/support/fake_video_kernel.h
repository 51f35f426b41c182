#pragma once

#include <linux/videodev2.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/v4l2/video_system.h"

namespace instep::test {

/// One video node and its driver, as far as a capture program can see them.
struct FakeVideoDevice {
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<std::uint32_t> formats{V4L2_PIX_FMT_Z16};
  std::vector<v4l2_frmsize_discrete> sizes{};  ///< of each format; none = any
  /// What S_FMT answers is what was asked, changed by these.
  std::optional<std::uint32_t> other_code{};
  std::optional<std::uint32_t> other_width{};
  std::uint32_t padding = 0;  ///< bytes after each row
  std::optional<std::uint32_t> other_line{};
  std::optional<std::uint32_t> other_image_size{};
  std::uint32_t buffers = 4;
  int stream_on_error = 0;

  struct Control {
    std::string name{};
    int minimum = 0;
    int maximum = 100;
    int step = 1;
    int value = 0;
    std::string locked_by{};  ///< keeps its value until that control is 1
  };
  std::vector<Control> controls{};

  /// How the next images come; after them, good ones without end unless `silent`.
  struct Image {
    bool flagged = false;
    std::optional<std::uint32_t> bytes{};  ///< fewer than there should be
    std::uint32_t lost_before = 0;         ///< a gap in the sequence
    std::optional<std::uint32_t> sequence{};
    std::optional<std::chrono::microseconds> stamp{};
    std::uint32_t clock = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  };
  std::deque<Image> images{};
  bool silent = false;
};

/// A kernel with V4L2 devices, strict about what V4L2 asks of a program: a buffer is queued once, a
/// node is busy as long as anybody has buffers or mappings of it, and a device that left answers
/// ENODEV to everything but close and munmap. Any call can be made to fail. Thread-safe.
///
/// A pixel of an image is its place in the image plus the sequence number, modulo 2^16; bytes that
/// pad rows, and planes that are not depth, are 0xEE.
class FakeVideoKernel final : public VideoSystem {
 public:
  void add(const std::string& path, FakeVideoDevice device);
  /// The device leaves; who has it open finds out.
  void remove(const std::string& path);
  /// Changes a device that is there, by `change(FakeVideoDevice&)`.
  template <typename Change>
  void change(const std::string& path, Change change) {
    const std::lock_guard lock(mutex_);
    change(nodes_.at(path)->device);
  }

  /// The k-th call from now on, counted from 1, fails with `error` and does nothing.
  void fail_call(int k, int error);
  int calls() const;
  /// What programs still hold: descriptors and mappings.
  int held() const;
  /// Calls that no driver would take kindly: a buffer queued twice, one that is no buffer.
  int misuses() const;

  int open(const char* path, int flags) override;
  int close(int descriptor) override;
  int control(int descriptor, unsigned long request, void* argument) override;
  void* map(std::size_t length, int descriptor, off_t offset) override;
  int unmap(void* memory, std::size_t length) override;
  int poll(pollfd* waiting, nfds_t count, int timeout_ms) override;

 private:
  enum class Where { kProgram, kQueue, kDone };
  struct Buffer {
    std::vector<std::uint8_t> memory;
    bool mapped = false;
    Where where = Where::kProgram;
    v4l2_buffer filled{};
  };
  struct Node {
    FakeVideoDevice device;
    v4l2_format format{};
    std::vector<std::unique_ptr<Buffer>> buffers;
    int owner = -1;  ///< the descriptor that has the buffers
    bool streaming = false;
    bool gone = false;
    std::uint32_t sequence = 0;
    std::deque<std::size_t> queue;
    std::deque<std::size_t> done;
    bool is_mapped() const;
  };

  bool fails_now();
  int answer(Node& node, int descriptor, unsigned long request, void* argument);
  int set_format(Node& node, v4l2_format& format);
  int request_buffers(Node& node, int descriptor, v4l2_requestbuffers& request);
  int take_back(Node& node, v4l2_buffer& buffer);
  int give(Node& node, v4l2_buffer& buffer);
  int query_control(const Node& node, v4l2_queryctrl& query);
  int set_control(Node& node, v4l2_control& control);
  void produce(Node& node);
  short state_of(Node& node);

  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Node>> nodes_;
  std::map<int, std::shared_ptr<Node>> open_;
  std::map<void*, std::shared_ptr<Node>> mappings_;
  int calls_ = 0;
  int failing_call_ = 0;
  int failure_ = 0;
  int misuses_ = 0;
};

}  // namespace instep::test
