#include "drivers/gpio/gpio_pedal.h"

#include <fcntl.h>
#include <gpiod.h>
#include <sys/inotify.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "drivers/files/descriptor.h"
#include "drivers/files/poll_set.h"

namespace instep {
namespace {

/// Most edges of one call: a line that never rests must not keep its reader for ever.
constexpr std::size_t kMostEdges = 256;

int request_flags(const GpioPedal::Settings& settings) {
  int flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  switch (settings.bias) {
    case GpioBias::kPullUp:
      return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    case GpioBias::kPullDown:
      return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    case GpioBias::kNone:
      return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
  }
  return flags;
}

PedalEdge edge_of(const gpiod_line_event& event) {
  return {event.event_type == GPIOD_LINE_EVENT_RISING_EDGE,
          std::chrono::seconds(event.ts.tv_sec) + std::chrono::nanoseconds(event.ts.tv_nsec)};
}

}  // namespace

struct GpioPedal::Connection {
  GpioLine line;
  Descriptor nodes{inotify_init1(IN_NONBLOCK | IN_CLOEXEC)};
  PollSet waiting;
  const int unopened = nodes.is_open() && waiting.is_open() ? 0 : errno;
  int edges = -1;  ///< owned by the line

  explicit Connection(GpioLine found) : line(std::move(found)) {}

  /// The errno value of what fails; 0 if all goes well.
  int watch(const std::filesystem::path& devices) {
    if (unopened != 0) return unopened;
    edges = gpiod_line_event_get_fd(line.get());
    const bool ready = fcntl(edges, F_SETFL, O_NONBLOCK) == 0 &&
                       inotify_add_watch(nodes.number(), devices.c_str(), IN_DELETE) >= 0 &&
                       waiting.add(nodes.number()) && waiting.add(edges);
    return ready ? 0 : errno;
  }

  /// Whether a device node went since the last call.
  bool a_node_went() const {
    alignas(inotify_event) std::array<char, 4096> events;
    bool went = false;
    while (read(nodes.number(), events.data(), events.size()) > 0) went = true;
    return went;
  }

  std::optional<bool> level() const {
    const int value = gpiod_line_get_value(line.get());
    return value < 0 ? std::nullopt : std::optional(value == 1);
  }
};

GpioPedal::GpioPedal(const Settings& settings) : settings_(settings) {}

GpioPedal::~GpioPedal() = default;

Result<std::unique_ptr<GpioPedal>> GpioPedal::open(const Settings& settings) {
  std::unique_ptr<GpioPedal> pedal(new GpioPedal(settings));
  if (const auto connected = pedal->connect(); !connected) {
    return tl::make_unexpected(connected.error());
  }
  return pedal;
}

int GpioPedal::descriptor() const {
  return connection_ ? connection_->waiting.descriptor() : -1;
}

Result<void> GpioPedal::connect() {
  auto line = GpioLine::find(settings_.address, settings_.devices);
  if (!line) return tl::make_unexpected(line.error());
  auto connection = std::make_unique<Connection>(std::move(*line));
  gpiod_line* const found = connection->line.get();
  if (gpiod_line_request_both_edges_events_flags(found, "instep pedal", request_flags(settings_)) !=
      0) {
    return tl::make_unexpected(connection->line.request_failure(errno));
  }
  if (const int failed = connection->watch(settings_.devices); failed != 0) {
    return fail(ErrorCode::kIo,
                std::string("the GPIO pedal cannot be watched: ") + strerror(failed),
                "raise the limits of open files and of inotify instances");
  }
  // It may have left before its node was watched.
  if (!connection->level()) return gone();
  connection_ = std::move(connection);
  gone_ = false;
  return {};
}

tl::unexpected<Error> GpioPedal::gone() {
  gone_ = true;
  return fail(ErrorCode::kDeviceGone, "the GPIO chip of the pedal left", "plug its board in again");
}

Result<std::vector<PedalEdge>> GpioPedal::read_edges() {
  if (gone_) return gone();
  if (connection_->a_node_went() && !connection_->level()) return gone();
  std::vector<PedalEdge> edges;
  std::array<gpiod_line_event, 16> events;
  while (edges.size() < kMostEdges) {
    const int count =
        gpiod_line_event_read_fd_multiple(connection_->edges, events.data(), events.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno != EAGAIN) return gone();
    if (count <= 0) break;
    for (int i = 0; i < count; ++i) edges.push_back(edge_of(events[static_cast<std::size_t>(i)]));
  }
  return edges;
}

Result<bool> GpioPedal::is_pressed() {
  if (gone_) return gone();
  const auto level = connection_->level();
  if (!level) return gone();
  return *level;
}

Result<void> GpioPedal::reopen() {
  if (connection_ && !gone_) return {};
  gone_ = true;
  connection_.reset();
  return connect();
}

}  // namespace instep
