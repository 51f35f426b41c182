#include "daemon/page/pdf_page.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "drivers/files/descriptor.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

constexpr int kLongestMs = 10000;
constexpr const char* kProgram = "rsvg-convert";

tl::unexpected<Error> failed(int error_number, const char* doing) {
  return tl::make_unexpected(file_error(error_number, doing, "a page of PDF"));
}

Result<std::string> read_all(int file) {
  std::string bytes;
  std::array<char, 65536> part;
  if (::lseek(file, 0, SEEK_SET) < 0) return failed(errno, "read");
  while (true) {
    const ssize_t count = ::read(file, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed(errno, "read");
    if (count == 0) return bytes;
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// Starts the program with its input and output on files in memory: no pipe can fill up. What it
/// complains of goes nowhere, since a command says what is wrong in one line of its own.
Result<pid_t> start(int input, int output) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = kProgram;
  std::string format = "--format=pdf";
  std::array<char*, 3> arguments = {name.data(), format.data(), nullptr};
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, kProgram, &files, nullptr, arguments.data(), ::environ);
  posix_spawn_file_actions_destroy(&files);
  if (error == 0) return child;
  return fail(ErrorCode::kUnsupported, "there is no program rsvg-convert, which makes PDF",
              "install it (apt-get install librsvg2-bin), or write an .svg");
}

/// The exit status of a child; kills it if it takes too long.
Result<int> wait_for(pid_t child) {
  const Descriptor watch(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  pollfd end{watch.number(), POLLIN, 0};
  int ready = watch.is_open() ? 0 : 1;  // where no end can be watched, it is waited for
  while (ready == 0) {
    ready = ::poll(&end, 1, kLongestMs);
    if (ready == 0) break;
    if (ready < 0 && errno == EINTR) ready = 0;
  }
  if (ready <= 0) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (ready > 0) return status;
  return fail(ErrorCode::kTimeout, "rsvg-convert did not end within ten seconds",
              "try again, or write an .svg");
}

}  // namespace

Result<std::string> pdf_of_page(const std::string& svg) {
  const Descriptor input(::memfd_create("page.svg", MFD_CLOEXEC));
  const Descriptor output(::memfd_create("page.pdf", MFD_CLOEXEC));
  if (!input.is_open() || !output.is_open() || !write_all(input.number(), svg) ||
      ::lseek(input.number(), 0, SEEK_SET) != 0) {
    return failed(errno, "make");
  }
  const auto child = start(input.number(), output.number());
  if (!child) return tl::make_unexpected(child.error());
  const auto status = wait_for(*child);
  if (!status) return tl::make_unexpected(status.error());
  auto pdf = read_all(output.number());
  if (!pdf) return pdf;
  if (*status == 0 && pdf->starts_with("%PDF-")) return pdf;
  return fail(ErrorCode::kIo, "rsvg-convert made no PDF of the page",
              "check that librsvg2-bin is installed well, or write an .svg");
}

}  // namespace instep
