#include "tests/support/model_board.h"
#include "tests/support/output_contract.h"

namespace instep::test {
namespace {

class Backend {
 public:
  auto open() { return board_.open("lamp"); }
  bool is_on() const { return board_.is_on("lamp"); }
  void unplug() { board_.unplug(); }
  void plug_in() { board_.plug_in(); }

 private:
  ModelBoard board_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(ModelBoard, OutputContract, Backend);

}  // namespace
}  // namespace instep::test
