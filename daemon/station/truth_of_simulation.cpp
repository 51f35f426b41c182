#include "daemon/station/truth_of_simulation.h"

#include <memory>
#include <utility>

#include "daemon/loop/caught.h"

namespace instep {

std::shared_future<std::map<std::string, double>> truth_of_simulation(
    TaskThread& thread, std::function<Result<std::map<std::string, double>>()> work) {
  if (!work) return {};
  const auto promise = std::make_shared<std::promise<std::map<std::string, double>>>();
  thread.post([promise, work = std::move(work)](TaskProgress&) {
    promise->set_value(caught("the truth", work).value_or(std::map<std::string, double>()));
  });
  return promise->get_future().share();
}

}  // namespace instep
