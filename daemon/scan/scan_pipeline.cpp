#include "daemon/scan/scan_pipeline.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/foot/align_feet.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/fusion/fuse_views.h"
#include "core/go_on.h"
#include "core/noticed.h"
#include "daemon/scan/all_processors.h"
#include "daemon/scan/camera_images.h"
#include "daemon/scan/scan_id.h"
#include "daemon/scan/stage_clock.h"

namespace instep {
namespace {

std::map<std::string, double> frame_quality(const Capture& capture,
                                            const std::vector<FusedDepth>& images) {
  std::map<std::string, double> quality;
  quality["frames_rejected"] = static_cast<double>(capture.frames_rejected);
  for (const auto& image : images) {
    quality["frames_used"] += image.frames_used;
    quality["frames_rejected"] += image.frames_rejected;
    quality["movement_mm"] = std::max(quality["movement_mm"], image.movement_mm);
  }
  return quality;
}

/// One for all cameras, of the one before which it moved most.
std::vector<std::string> movement_warnings(const std::vector<FusedDepth>& images) {
  double most_mm = 0.0;
  for (const auto& image : images) {
    if (image.moved) most_mm = std::max(most_mm, image.movement_mm);
  }
  if (!(most_mm > 0.0)) return {};
  return {fmt::format(
      "the foot moved by about {:.1f} mm during the scan: ask the customer to stand still and scan "
      "again",
      most_mm)};
}

Result<FusedScene> fuse_scene(const Capture& capture, std::vector<FusedDepth> images,
                              const PipelineSettings& settings, const GoOn& go_on) {
  FusionSettings fusion;
  fusion.point_spacing_mm = settings.point_spacing_mm;
  fusion.platform_height_mm = capture.platform_height_mm;
  fusion.refine_views = settings.refine_views;
  return fuse_views(views_of(capture, std::move(images)), fusion, on_all_processors, go_on);
}

AlignmentOptions alignment_of(const FusedScene& scene, const PipelineSettings& settings) {
  AlignmentOptions alignment;
  alignment.side = settings.side;
  alignment.rules = settings.measures;
  alignment.standing_plane = StandingPlane{Eigen::Vector3d::UnitZ(), scene.standing_height_mm};
  alignment.is_plane_guessed = !scene.is_standing_height_known;
  return alignment;
}

/// The part of the truth that is about one foot: see Capture::truth. It is known by the usual
/// definitions only.
std::map<std::string, double> truth_of(const Capture& capture, const FootScan& foot) {
  if (foot.rules != MeasuringRules{}) return {};
  const std::string prefix = std::string(to_string(foot.side)) + "_";
  std::map<std::string, double> own;
  for (const auto& [id, value] : capture.truth) {
    const bool is_sided = id.rfind("left_", 0) == 0 || id.rfind("right_", 0) == 0;
    if (!is_sided) own[id] = value;
    if (id.rfind(prefix, 0) == 0) own[id.substr(prefix.size())] = value;
  }
  return own;
}

/// Whoever stands there gives no points and no millimetres. What is no matter of the foot, such as
/// a scan that was cancelled, keeps its own advice.
Error of_scan(Error failure) {
  if (failure.code != ErrorCode::kInsufficientData && failure.code != ErrorCode::kInvalidInput) {
    return failure;
  }
  failure.advice =
      "stand with the whole foot flat on the platform, two feet a hand's breadth apart and nothing "
      "else on it, then scan again; where that does not help, scan one foot alone, see that no "
      "camera is missing, covered or turned away, check platform_height_mm and calibrate the "
      "cameras (instep calibrate)";
  return failure;
}

ScanRecord record_of(const Capture& capture, const PipelineSettings& settings, FootScan foot,
                     MeasureSet measures) {
  ScanRecord record;
  record.station = settings.station;
  record.devices = capture.cameras;
  record.calibration = capture.calibration;
  record.simulated = capture.simulated;
  record.truth = truth_of(capture, foot);
  record.foot = std::move(foot);
  record.sizes = shoe_sizes(record.foot, measures, settings.sizes);
  record.measures = std::move(measures);
  return record;
}

Result<ScanRecord> measure_one(FootScan aligned, const Capture& capture,
                               const PipelineSettings& settings, StageClock& clock) {
  const GoOn go_on = [&clock] { return clock.go_on(); };
  if (!clock.begin("landmarks", 0.7)) return cancelled();
  auto foot = find_landmarks_by(on_all_processors, std::move(aligned), go_on);
  if (!foot) return tl::make_unexpected(foot.error());

  if (!clock.begin("girths", 0.7)) return cancelled();
  MeasureOptions options;
  options.workers = on_all_processors;
  auto measures = measure_foot(*foot, options, go_on);
  if (!measures) return tl::make_unexpected(measures.error());
  return record_of(capture, settings, std::move(*foot), std::move(*measures));
}

void name(std::vector<ScanRecord>& records, const PipelineSettings& settings) {
  const auto time = std::chrono::system_clock::now();
  const auto ids = new_scan_ids(std::max(time, settings.ids_from.value_or(time)), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].id = ids[i];
    records[i].time = time;
  }
}

void pair_up(std::vector<ScanRecord>& records, const SizeRules& rules) {
  const bool are_pair = records.size() == 2 && records[0].foot.side == Side::kLeft &&
                        records[1].foot.side == Side::kRight;
  if (!are_pair) return;
  const auto& left = records[0].measures;
  const auto& right = records[1].measures;
  const SizedFoot larger = larger_of(sized_foot(left), sized_foot(right));
  ScannedPair pair{records[0].id, records[1].id, pair_feet(left, right),
                   shoe_sizes(records[0].foot, larger, rules)};
  for (auto& note : notes_of_one_foot(sized_foot(left), sized_foot(right))) {
    pair.sizes.notes.push_back(std::move(note));
  }
  for (auto& record : records) record.pair = pair;
}

void add_scene_quality(const FusedScene& scene, std::map<std::string, double>& quality) {
  const auto& figures = scene.diagnostics;
  quality["views_used"] = static_cast<double>(figures.views_used);
  quality["platform_found"] = figures.platform_found ? 1.0 : 0.0;
  quality["platform_tilt_deg"] = figures.platform_tilt_deg;
  quality["registration_before_mm"] = figures.registration_before_mm;
  quality["registration_after_mm"] = figures.registration_after_mm;
  quality["unexplained_mm"] = figures.unexplained_mm;
  quality["depths_bent_mm"] = figures.bent.sigma_mm;
  quality["poses_off_mm"] = figures.poses_off_mm;
  if (figures.lenses_off) quality["lenses_off_percent"] = 100.0 * *figures.lenses_off;
}

/// With what the cameras missed of each foot.
std::vector<std::string> all_noticed(const FusedScene& scene, std::vector<std::string> warnings) {
  for (const auto& own : scene.foot_warnings) {
    warnings.insert(warnings.end(), own.begin(), own.end());
  }
  return warnings;
}

}  // namespace

Result<std::vector<ScanRecord>> measure_capture(const Capture& capture,
                                                const PipelineSettings& settings,
                                                const ScanProgress& progress) {
  StageClock clock(progress);
  const GoOn go_on = [&clock] { return clock.go_on(); };

  if (!clock.begin("fuse frames", 0.0)) return cancelled();
  auto images = camera_images(capture, go_on);
  if (!images) return tl::make_unexpected(images.error());
  auto quality = frame_quality(capture, *images);
  auto warnings = movement_warnings(*images);
  for (auto& warning : rejection_warnings(*images)) warnings.push_back(std::move(warning));

  if (!clock.begin("fuse views", 0.2)) return cancelled();
  const auto scene = fuse_scene(capture, std::move(*images), settings, go_on);
  if (!scene) return tl::make_unexpected(with_what_was_noticed(scene.error(), warnings));
  add_scene_quality(*scene, quality);
  warnings.insert(warnings.end(), scene->warnings.begin(), scene->warnings.end());
  const auto noticed = [&](const Error& failure) {
    return tl::make_unexpected(with_what_was_noticed(failure, all_noticed(*scene, warnings)));
  };

  if (!clock.begin("align", 0.6)) return cancelled();
  auto feet = align_feet(scene->feet, alignment_of(*scene, settings), go_on);
  if (!feet) return noticed(of_scan(feet.error()));
  if (feet->size() > 1 && settings.side) {
    warnings.emplace_back(
        "two feet: which is which is told by where they stand; the side that was given was not "
        "used");
  }

  std::vector<ScanRecord> records;
  for (auto& aligned : *feet) {
    const auto& own = scene->foot_warnings.at(aligned.cloud_number);
    aligned.warnings.insert(aligned.warnings.begin(), own.begin(), own.end());
    auto record = measure_one(std::move(aligned), capture, settings, clock);
    if (!record) return noticed(record.error());
    records.push_back(std::move(*record));
  }
  clock.end();

  name(records, settings);
  pair_up(records, settings.sizes);
  for (auto& record : records) {
    record.quality = quality;
    record.warnings = warnings;
    record.timings_ms = clock.timings_ms();
  }
  return records;
}

}  // namespace instep
