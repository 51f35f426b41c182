#include "daemon/command_line/doctor/pedal_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include "tests/support/contact_pedal.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::Contact;
using test::ContactPedal;
using testing::HasSubstr;

/// One that hangs as soon as it has been read.
class HangsInClosing final : public Pedal {
 public:
  explicit HangsInClosing(std::shared_ptr<Contact> contact)
      : contact_(std::move(contact)), pedal_(contact_) {}
  int descriptor() const override { return pedal_.descriptor(); }
  Result<std::vector<PedalEdge>> read_edges() override {
    auto edges = pedal_.read_edges();
    contact_->hang();
    return edges;
  }
  Result<bool> is_pressed() override { return pedal_.is_pressed(); }
  Result<void> reopen() override { return pedal_.reopen(); }

 private:
  std::shared_ptr<Contact> contact_;
  ContactPedal pedal_;
};

class PedalCheck : public testing::Test {
 protected:
  template <class Kind>
  DoctorCheck check(std::chrono::milliseconds patience) {
    auto made = check_pedal(
        {},
        [contact = contact_]() -> Result<std::unique_ptr<Pedal>> {
          return std::make_unique<Kind>(contact);
        },
        patience);
    contact_->let_go();
    EXPECT_TRUE(contact_->wait_until_closed(1));
    return made;
  }
  static DoctorCheck check_failure(ErrorCode code) {
    return check_pedal(
        {}, [code] { return fail(code, "it is not to be had", "see to it"); }, 1h);
  }

  std::shared_ptr<Contact> contact_ = std::make_shared<Contact>();
};

TEST_F(PedalCheck, IsGoodWhereItCanBeOpenedAndClosesItAgain) {
  const auto good = check<ContactPedal>(1h);
  EXPECT_TRUE(good.good) << good.finding;
  EXPECT_EQ(good.finding, "can be opened");
}

// The doctor hung with it, and told nothing of all the rest.
TEST_F(PedalCheck, SaysThatItDoesNotAnswerWhereItHangsInOpening) {
  contact_->hang();
  const auto silent = check<ContactPedal>(20ms);
  EXPECT_TRUE(silent.is_wrong());
  EXPECT_EQ(silent.finding, "the pedal does not answer");
  EXPECT_THAT(silent.remedy, HasSubstr("plug it in again"));
}

TEST_F(PedalCheck, SaysThatItDoesNotAnswerWhereItHangsInReading) {
  contact_->hang_in_reading();
  EXPECT_EQ(check<ContactPedal>(20ms).finding, "the pedal does not answer");
}

TEST_F(PedalCheck, SaysThatItDoesNotAnswerWhereItHangsInClosing) {
  EXPECT_EQ(check<HangsInClosing>(500ms).finding, "the pedal does not answer");
}

TEST_F(PedalCheck, TellsWhyItCannotBeOpened) {
  const auto held = check_failure(ErrorCode::kBusy);
  EXPECT_TRUE(held.is_wrong());
  EXPECT_EQ(held.finding, "it is not to be had");
  EXPECT_EQ(held.remedy, "see to it");
  EXPECT_TRUE(check_failure(ErrorCode::kPermissionDenied).unseen);
}

}  // namespace
}  // namespace instep
