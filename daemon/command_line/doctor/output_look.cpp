#include "daemon/command_line/doctor/output_look.h"

#include <future>
#include <memory>
#include <string>
#include <utility>

#include "daemon/loop/caught.h"
#include "daemon/loop/task_thread.h"

namespace instep {
namespace {

using std::chrono::steady_clock;

/// A look that goes on.
struct Look {
  std::string name;
  std::future<Result<void>> outcome;
  std::unique_ptr<TaskThread> thread;
};

Look begin(const OutputSettings::Named& output, const LookForOutput& look) {
  const auto outcome = std::make_shared<std::promise<Result<void>>>();
  Look begun{output.name, outcome->get_future(), std::make_unique<TaskThread>(output.name)};
  begun.thread->post([outcome, look, settings = *output.output](TaskProgress&) {
    outcome->set_value(caught("the look for an output", [&] { return look(settings); }));
  });
  return begun;
}

OutputFinding end(Look& look, steady_clock::time_point deadline) {
  const bool is_over = look.outcome.wait_until(deadline) == std::future_status::ready;
  const Result<void> outcome =
      is_over ? look.outcome.get() : Result<void>(tl::make_unexpected(silent_output()));
  look.thread->stop_by(deadline);
  if (outcome) return {look.name, "", ""};
  const Error& error = outcome.error();
  return {look.name, error.message, error.advice, error.code == ErrorCode::kPermissionDenied};
}

}  // namespace

std::vector<OutputFinding> look_for_outputs(const OutputSettings& outputs,
                                            const LookForOutput& look,
                                            std::chrono::milliseconds patience) {
  std::vector<Look> looks;
  for (const auto& output : outputs.named()) looks.push_back(begin(output, look));
  const auto deadline = steady_clock::now() + patience;
  std::vector<OutputFinding> found;
  for (auto& one : looks) found.push_back(end(one, deadline));
  return found;
}

}  // namespace instep
