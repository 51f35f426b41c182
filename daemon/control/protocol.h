#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "daemon/station/station_status.h"
#include "daemon/store/stored_result.h"

namespace instep {

/// The local protocol: lines of JSON over a Unix stream socket (mode 0660).
///
/// A request is one object a line, at most kLongestRequest bytes:
///
///     {"verb": "status"}
///     {"verb": "show", "id": "latest"}
///
/// | verb     | with | what the answer holds beside "ok"                                       |
/// |----------|------|-------------------------------------------------------------------------|
/// | scan     |      | nothing; the scan has begun. Its end comes as an event to watchers       |
/// | cancel   |      | nothing; the scan will end                                               |
/// | status   |      | state, trouble (the first), troubles, stage, done, cameras, pedal, ...   |
/// | watch    |      | as status; events follow on this connection until it is closed           |
/// | list     |      | scans: [{id}, ...], newest first                                         |
/// | show     | id   | id, folder, result: what result.json holds                               |
/// | export   | id   | id, folder, files: names in it, for the caller to copy                   |
/// | delete   | id   | id, pair: the scan whose other foot it was, if it was of a pair          |
///
/// `id` may be "latest", but not for delete. Every request is answered by one line:
/// {"ok": true, ...} or {"ok": false, "error": {"code", "remedy", "message", "advice"}}. The
/// requests of one connection are done and answered in order, however many are sent at once; who
/// shuts down the writing side of the connection is still answered all of them.
///
/// Events are lines with "event":
///
///     {"event": "status", ...as the status answer}
///     {"event": "result", "scans": [{"id", "folder", "side"}, ...]}
///     {"event": "failure", "error": {...}}
///     {"event": "ignored", "presses": 3}
///
/// Who starts to watch is first told the result of a scan that ended within the last
/// kRecentResult, so that pressing and then watching misses nothing.
///
/// A line that is too long or a client that does not read what it is sent loses its connection, as
/// does who is quiet and waits for nothing when there are too many; what is no request is answered
/// with an error.
inline constexpr std::size_t kLongestRequest = 4096;
inline constexpr std::chrono::seconds kRecentResult{5};

struct Request {
  std::string verb;
  std::string id;  ///< empty if none was given
};

/// Checks that a line is a request that can be answered: known verb, known keys, an id where one is
/// needed. Never throws.
Result<Request> parse_request(std::string_view line);

/// Lines without their end.
std::string ok_answer(const nlohmann::json& content);
std::string error_answer(const Error& error);
std::string event_line(const char* event, const nlohmann::json& content);

nlohmann::json to_json(const Error& error);
nlohmann::json to_json(const StationStatus& status);
nlohmann::json to_json(const std::vector<StoredResult>& results);

/// What a client is told of an answer that is of another shape than agreed.
Error answer_not_understood();

/// The Error in an answer, as the client sees it; nothing if the answer is good.
Result<void> answer_outcome(const nlohmann::json& answer);

}  // namespace instep
