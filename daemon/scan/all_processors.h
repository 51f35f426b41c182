#pragma once

#include <cstddef>
#include <functional>

namespace instep {

/// core/workers.h by as many threads as there are processors, or jobs if these are fewer. The
/// calling thread is one of them, so that all is done even where no other can be started. What a
/// job throws is thrown here, when no job runs any more; others may be left undone then.
void on_all_processors(std::size_t count, const std::function<void(std::size_t job)>& work);

}  // namespace instep
