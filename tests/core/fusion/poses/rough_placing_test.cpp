#include "core/fusion/poses/rough_placing.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "core/fusion/poses/seen_object.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

using Eigen::Vector3d;

WorkingView view_of(const CameraGeometry& camera, const Surfaces& scene) {
  TemporalFusion fusion;
  EXPECT_TRUE(fusion.add(render(camera, scene, {}, 1)));
  auto view = open_view({camera, *fusion.result(), nullptr});
  EXPECT_TRUE(view);
  return *std::move(view);
}

std::vector<WorkingView> views_of_a_foot() {
  const Surfaces scene = {ellipsoid_surface({0, 0, 28}, {125, 45, 34}),
                          cylinder_surface({-60, 0}, 33, 30, 130),
                          disc_surface({0, 0, 0}, {0, 0, 1}, 400)};
  std::vector<WorkingView> views;
  for (const auto& camera : ring_of_cameras(4, 450, 250, {0, 0, 20})) {
    views.push_back(view_of(camera, scene));
  }
  return views;
}

LevelView level(const WorkingView& view) {
  return {view.posed(), station_cloud(view, object_pixels(view, 0.0))};
}

RigidTransform along_the_platform(double degrees, const Vector3d& shift) {
  RigidTransform moved = RigidTransform::Identity();
  moved.linear() =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitZ()).toRotationMatrix();
  moved.translation() = shift;
  return moved;
}

TEST(PlaceRoughly, BringsViewsBackThatWereTurnedAndShifted) {
  auto views = views_of_a_foot();
  const std::vector<RigidTransform> said = {
      along_the_platform(30.0, {200.0, -90.0, 0.0}), along_the_platform(0.0, {0.0, 0.0, 0.0}),
      along_the_platform(-22.0, {-60.0, 150.0, 0.0}), along_the_platform(9.0, {10.0, -20.0, 0.0})};
  std::vector<LevelView> levelled;
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].station_from_camera = said[i] * views[i].station_from_camera;
  }
  for (const auto& view : views) levelled.push_back(level(view));
  const auto moves = place_roughly(levelled);
  ASSERT_TRUE(moves);
  for (const double x : {-110.0, 110.0}) {
    const Vector3d place(x, 0.0, 30.0);
    const Vector3d first = (*moves)[0] * said[0] * place;
    for (std::size_t i = 1; i < views.size(); ++i) {
      EXPECT_LT(((*moves)[i] * said[i] * place - first).norm(), 20.0) << "view " << i;
    }
  }
}

TEST(PlaceRoughly, LeavesTheOneThatShowsMostWhereItIs) {
  const auto views = views_of_a_foot();
  auto first = level(views[0]);
  first.skin = first.skin.subset({0, 1, 2});
  const auto moves = place_roughly({first, level(views[1])});
  ASSERT_TRUE(moves);
  EXPECT_EQ((*moves)[1].matrix(), RigidTransform::Identity().matrix());
}

TEST(PlaceRoughly, LeavesAViewThatAgreesNowhereWhereItIs) {
  const auto views = views_of_a_foot();
  // What another camera sees of a body four times as high.
  const auto tall =
      view_of(ring_of_cameras(4, 450, 250, {0, 0, 20})[1],
              {cylinder_surface({0, 0}, 15, 0, 240), disc_surface({0, 0, 0}, {0, 0, 1}, 400)});
  const auto moves = place_roughly({level(views[0]), level(tall)});
  ASSERT_TRUE(moves);
  for (const auto& move : *moves) {
    EXPECT_EQ(move.matrix(), RigidTransform::Identity().matrix());
  }
}

TEST(PlaceRoughly, HasNothingToDoWithoutViewsOrSkin) {
  EXPECT_TRUE(place_roughly({})->empty());
  const auto views = views_of_a_foot();
  auto blind = level(views[1]);
  blind.skin = PointCloud();
  const auto moves = place_roughly({level(views[0]), blind});
  ASSERT_TRUE(moves);
  EXPECT_EQ((*moves)[1].matrix(), RigidTransform::Identity().matrix());
}

TEST(PlaceRoughly, EndsWhereItIsNoLongerWanted) {
  const auto views = views_of_a_foot();
  const auto moves =
      place_roughly({level(views[0]), level(views[1])}, one_after_the_other, [] { return false; });
  ASSERT_FALSE(moves);
  EXPECT_EQ(moves.error().code, ErrorCode::kCancelled);
}

TEST(PlaceRoughly, HeedsASingleNoWheneverItComes) {
  const auto views = views_of_a_foot();
  const std::vector<LevelView> two = {level(views[0]), level(views[1])};
  for (const int refused : {1, 2, 10, 18, 22, 26}) {
    int asked = 0;
    const auto moves = place_roughly(two, one_after_the_other, [&] { return ++asked != refused; });
    ASSERT_FALSE(moves) << "question " << refused;
    EXPECT_EQ(moves.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, refused);
  }
}

}  // namespace
}  // namespace instep
