#pragma once

#include <filesystem>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// The settings, with their real cameras where the calibration that lies beside their file has
/// those of the same name; Settings::calibration says what it did. Cameras of a simulation or a
/// recording bring their own poses, and without a calibration all stay as they are. Fails, naming
/// the file and what to do, if it cannot be read or is faulty: the settings' poses in its stead
/// would be wrong without a word.
///
/// One that was found from another station than the settings tell of is used all the same, and
/// warnings_of_poses() tells of it. The poses that a person wrote since are a tape's, centimetres
/// off where a unit swapped or a number mended leaves the calibration right to some tenths of a
/// millimetre; and of one camera alone they would be in another frame than all the others. Where a
/// camera was really moved neither is right, and only a new calibration is.
Result<Settings> with_calibration_beside(const std::filesystem::path& settings_file,
                                         Settings settings);

}  // namespace instep
