#include "daemon/service/run_instepd.h"
#include "daemon/standard_streams.h"

int main(int argc, char** argv) {
  instep::fill_closed_standard_streams();
  return instep::run_instepd(argc, argv);
}
