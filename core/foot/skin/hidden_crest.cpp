#include "core/foot/skin/hidden_crest.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace instep {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kWidestGapMm = 8.0;
constexpr int kRounds = 8;
constexpr double kFurthestOff = 0.7;  ///< of half-widths
/// Of all samples together: those on a guess below the rim are all too far in.
constexpr double kAllOffMm = 0.5;
/// Of a sample off the curve: by noise, by the guess below the rim of what was seen, and by the
/// border's own bends; more than that of one alone, since those beside each other err alike.
constexpr double kSampleOffMm = 1.5;
/// Of the furthest of the samples that are a guess.
constexpr double kGuessOffMm = 3.0;

struct Sample {
  SkinBorder::Place place;
  double off_mm = 0.0;
};

/// Those that tell; where there are none, the furthest that is guessed.
std::vector<Sample> samples_near(const SkinBorder& told, const SkinBorder& guessed,
                                 const UsualBorder& usual) {
  const auto is_near = [&](const SkinBorder::Place& place) {
    return std::abs(place.along - usual.along) < usual.half_width_mm;
  };
  std::vector<Sample> near;
  for (const auto& place : told.samples()) {
    if (is_near(place)) near.push_back({place, kSampleOffMm});
  }
  if (!near.empty()) return near;
  for (const auto& place : guessed.samples()) {
    if (!is_near(place)) continue;
    if (near.empty()) near.push_back({place, kGuessOffMm});
    if (place.reach > near.front().place.reach) near.front().place = place;
  }
  return near;
}

Vector4d powers(double t) {
  return {1.0, t, t * t, t * t * t};
}

/// The border by powers of t, places off the usual one in half-widths.
struct Curve {
  Vector4d terms;
  Matrix4d covariance;
};

Curve most_likely(const std::vector<Sample>& samples, const UsualBorder& usual) {
  const double unit = usual.half_width_mm;
  const auto precision = [](double spread) { return 1.0 / (spread * spread); };
  const Vector3d scale(unit, unit * unit / 2.0, unit * unit * unit / 6.0);
  const Vector3d known = scale.cwiseProduct(usual.spreads).unaryExpr(precision);
  Matrix4d information = Matrix4d::Zero();
  information.diagonal().tail<3>() = known;
  Vector4d right = Vector4d::Zero();
  right.tail<3>() = known.cwiseProduct(scale).cwiseProduct(usual.derivatives);
  for (const auto& [sample, off] : samples) {
    const double t = (sample.along - usual.along) / unit;
    const Vector4d row = powers(t);
    information += precision(off) * row * row.transpose();
    right += precision(off) * sample.reach * row;
  }
  Matrix4d covariance = information.inverse();
  const Vector4d likely = covariance * right;
  covariance(0, 0) += kAllOffMm * kAllOffMm;
  return {likely, covariance};
}

Vector4d slopes(double t) {
  return {0.0, 1.0, 2.0 * t, 3.0 * t * t};
}

/// Second derivative at t, less that of the handicap.
double weighed_bend(const Vector4d& terms, double handicap, double t) {
  return 2.0 * terms(2) + 6.0 * terms(3) * t - handicap;
}

/// Where the curve less its handicap is highest, by Newton from the usual place.
std::optional<double> crest_of(const Vector4d& terms, const UsualBorder& usual, double handicap) {
  const double from = std::max((usual.from - usual.along) / usual.half_width_mm, -kFurthestOff);
  const double to = std::min((usual.to - usual.along) / usual.half_width_mm, kFurthestOff);
  double t = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const double bend = weighed_bend(terms, handicap, t);
    if (!(bend < 0.0)) return std::nullopt;
    const double slope = terms.dot(slopes(t)) - handicap * t;
    t = std::clamp(t - slope / bend, from, to);
  }
  return weighed_bend(terms, handicap, t) < 0.0 ? std::optional(t) : std::nullopt;
}

}  // namespace

bool has_gap(const SkinBorder& border, double from, double to) {
  double last = from;
  for (const auto& sample : border.samples()) {
    if (sample.along < from) continue;
    if (sample.along > to) break;
    if (sample.along - last > kWidestGapMm) return true;
    last = sample.along;
  }
  return to - last > kWidestGapMm;
}

std::optional<HiddenCrest> hidden_crest(const SkinBorder& told, const SkinBorder& guessed,
                                        const UsualBorder& usual) {
  const auto samples = samples_near(told, guessed, usual);
  if (samples.empty()) return std::nullopt;
  const auto [terms, covariance] = most_likely(samples, usual);
  const double unit = usual.half_width_mm;
  const double handicap = usual.handicap_bend_per_mm * unit * unit;
  const auto t = crest_of(terms, usual, handicap);
  if (!t) return std::nullopt;
  HiddenCrest crest;
  crest.place.along = usual.along + *t * unit;
  crest.place.reach = terms.dot(powers(*t));
  for (const auto& sample : samples) {
    crest.place.across += sample.place.across / static_cast<double>(samples.size());
  }
  // How far along and outwards the crest moves with each of the terms.
  const Vector4d along = slopes(*t) / -weighed_bend(terms, handicap, *t);
  const Vector4d outwards = powers(*t) + handicap * *t * along;
  Eigen::Matrix<double, 2, 4> moves;
  moves << unit * along.transpose(), outwards.transpose();
  const Eigen::Matrix2d root = (moves * covariance * moves.transpose()).llt().matrixL();
  crest.deviations_off_mm = {root.col(0), root.col(1)};
  const double open_share = std::sqrt(covariance(1, 1)) / (usual.spreads(0) * unit);
  crest.told_share = std::clamp(1.0 - open_share, 0.0, 1.0);
  return crest;
}

}  // namespace instep
