#include "tests/support/bent_capture.h"

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

constexpr double kAtMm = 500.0;

/// An image that goes on at its other side where it ends.
struct Image {
  int width;
  int height;
  std::vector<double> values;

  double& at(int u, int v) {
    return values[static_cast<std::size_t>((v + height) % height * width + (u + width) % width)];
  }
};

/// Weights whose squares sum to one: white noise keeps its variance.
std::vector<double> bell_of(double width_px) {
  const int reach = static_cast<int>(3.0 * width_px) + 1;
  std::vector<double> bell;
  double squares = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    bell.push_back(width_px > 0.0 ? std::exp(-0.5 * i * i / (width_px * width_px))
                                  : (i == 0 ? 1.0 : 0.0));
    squares += bell.back() * bell.back();
  }
  for (double& weight : bell) weight /= std::sqrt(squares);
  return bell;
}

Image smoothed(Image image, const std::vector<double>& bell, bool is_upright) {
  Image smooth = image;
  const int reach = static_cast<int>(bell.size() / 2);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      double sum = 0.0;
      for (int i = -reach; i <= reach; ++i) {
        const double weight = bell[static_cast<std::size_t>(i + reach)];
        sum += weight * (is_upright ? image.at(u, v + i) : image.at(u + i, v));
      }
      smooth.at(u, v) = sum;
    }
  }
  return smooth;
}

Image smooth_noise(int width, int height, double width_px, RandomNumbers& random) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.values.push_back(random.normal());
  const auto bell = bell_of(width_px);
  return smoothed(smoothed(std::move(image), bell, false), bell, true);
}

}  // namespace

void bend_depths(const BentCamera& bent, std::uint64_t seed, Capture& capture) {
  RandomNumbers random(seed);
  for (const auto& camera : capture.cameras) {
    std::vector<double> bends;
    for (auto& frame : capture.frames) {
      if (frame.camera != camera.geometry.id) continue;
      if (bends.empty()) {
        bends = smooth_noise(frame.width, frame.height, bent.width_px, random).values;
      }
      for (std::size_t pixel = 0; pixel < frame.raw.size(); ++pixel) {
        if (frame.raw[pixel] == 0) continue;
        double depth = frame.raw[pixel] * frame.depth_unit_mm;
        depth += bent.sigma_mm * std::pow(depth / kAtMm, 2) * bends[pixel];
        frame.raw[pixel] = static_cast<std::uint16_t>(std::lround(depth / frame.depth_unit_mm));
      }
    }
  }
}

}  // namespace instep::test
