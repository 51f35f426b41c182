#include "daemon/service/run_instepd.h"

int main(int argc, char** argv) {
  return instep::run_instepd(argc, argv);
}
