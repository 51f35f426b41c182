#pragma once

#include <string>
#include <vector>

#include "tests/bench/peers/peer.h"

namespace instep::bench {

/// Bodies of one kind; lasts and scanned feet only where the trial data is present.
enum class PeerBodies { kSimulatedFeet, kScannedFeet, kLasts };

/// Clouds of the bodies of a kind with about so many points, even where there is a choice, and
/// with noise along the normals.
std::vector<PeerSubject> peer_subjects(PeerBodies bodies, std::size_t points, double sigma_mm);

}  // namespace instep::bench
