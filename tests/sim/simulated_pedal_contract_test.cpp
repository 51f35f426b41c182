#include <fstream>

#include "sim/simulated_pedal.h"
#include "tests/support/pedal_contract.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

/// Pressed by the program itself.
class DirectBackend {
 public:
  Pedal& pedal() { return *pedal_; }
  void press() { pedal_->press(); }
  void release() { pedal_->release(); }
  void unplug() { pedal_->unplug(); }
  void plug_in() { pedal_->plug_in(); }

 private:
  std::unique_ptr<SimulatedPedal> pedal_ = SimulatedPedal::open({}).value();
};

/// Pressed by lines in a FIFO, as from a shell.
class FifoBackend {
 public:
  Pedal& pedal() { return *pedal_; }
  void press() { write_line("press"); }
  void release() { write_line("release"); }
  void unplug() { pedal_->unplug(); }
  void plug_in() { pedal_->plug_in(); }

 private:
  void write_line(const char* line) { std::ofstream(fifo_) << line << '\n'; }

  TemporaryFolder folder_;
  std::filesystem::path fifo_ = folder_.path() / "pedal";
  std::unique_ptr<SimulatedPedal> pedal_ = SimulatedPedal::open({{}, fifo_}).value();
};

using Backends = testing::Types<DirectBackend, FifoBackend>;
INSTANTIATE_TYPED_TEST_SUITE_P(SimulatedPedal, PedalContract, Backends);

}  // namespace
}  // namespace instep::test
