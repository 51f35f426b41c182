#pragma once

#include <string>

#include "daemon/control/protocol.h"
#include "daemon/store/result_store.h"

namespace instep {

/// Answers list, show, export and delete of the local protocol. Reads the disk, so not on the event
/// loop. Delete tells in `pair` the scan of the person's other foot, which still holds the numbers
/// of both. `on_day` as in ResultStore::list().
std::string answer_from_store(
    ResultStore& store, const Request& request, const ResultStore::OnDay& on_day = [] {});

}  // namespace instep
