#include "bench/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>

#include "data/base/error.h"

namespace floe {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::no_result, fmt::format("{}: {}", what, std::strerror(errno)));
}

struct Pipe {
  int read = -1, write = -1;
};
// Not inherited by programs that a child turns into.
Pipe open_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("cannot open a pipe");
  return {ends[0], ends[1]};
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return;  // nobody reads: the parent has gone
    if (n > 0) done += static_cast<std::size_t>(n);
  }
}

std::string read_all(int file) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t n = read(file, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

struct Ended {
  int status;
  ProcessCost cost;
};
Ended wait_for(pid_t child, Clock::time_point start) {
  Ended ended{};
  rusage usage{};
  while (wait4(child, &ended.status, 0, &usage) < 0)
    if (errno != EINTR) fail("cannot wait for a process");
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  ended.cost.wall_seconds = seconds_since(start);
  ended.cost.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ended.cost.peak_megabytes = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return ended;
}

struct Child {
  pid_t pid;
  Clock::time_point start;
  int ready, go, result;  // ends of pipes that the parent holds
};

// In the child: does the work, hands the result over, never returns.
[[noreturn]] void serve(const ChildWork& work, int ready, int go, int result) {
  Json answer;
  try {
    answer["result"] = work([&] {
      write_all(ready, "r");
      read_all(go);  // until the parent closes its end
    });
  } catch (const Error& error) {
    answer = {{"error", error.what()}, {"code", static_cast<int>(error.code())}};
  } catch (const std::exception& error) {
    answer = {{"error", error.what()}, {"code", static_cast<int>(ExitCode::no_result)}};
  }
  write_all(result, answer.dump());
  // Without running what the parent has registered for its own end.
  _exit(0);
}

Child start_child(const ChildWork& work, const std::vector<Child>& earlier) {
  const Pipe ready = open_pipe(), go = open_pipe(), result = open_pipe();
  std::fflush(nullptr);
  const auto start = Clock::now();
  const pid_t pid = fork();
  if (pid < 0) fail("cannot start a process");
  if (pid == 0) {
    // While this one holds them too, the others would never see their `go` closed.
    for (const Child& other : earlier) close(other.go);
    close(ready.read), close(go.write), close(result.read);
    serve(work, ready.write, go.read, result.write);
  }
  close(ready.write), close(go.read), close(result.write);
  return {pid, start, ready.read, go.write, result.read};
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t most = 500;
  return text.size() <= most ? text : "..." + text.substr(text.size() - most);
}

}  // namespace

std::vector<ChildResult> run_in_children(const std::vector<ChildWork>& work) {
  std::vector<Child> children;
  for (const ChildWork& piece : work) children.push_back(start_child(piece, children));
  for (const Child& child : children) {
    char byte;
    while (read(child.ready, &byte, 1) < 0 && errno == EINTR) {
    }
  }
  for (const Child& child : children) close(child.go);

  std::vector<ChildResult> results;
  std::optional<Error> problem;
  for (const Child& child : children) {
    const std::string text = read_all(child.result);
    const Ended ended = wait_for(child.pid, child.start);
    close(child.ready), close(child.result);
    const Json answer = Json::parse(text, nullptr, false);
    if (answer.is_discarded())
      problem = Error(ExitCode::no_result,
                      fmt::format("a process ended without a result (status {})", ended.status));
    else if (answer.contains("error"))
      problem = Error(static_cast<ExitCode>(answer["code"].get<int>()), answer["error"].get<std::string>());
    else
      results.push_back({answer["result"], ended.cost});
  }
  if (problem) throw *problem;
  return results;
}

ChildResult run_in_child(const std::function<Json()>& work) {
  return run_in_children({[&](const std::function<void()>&) { return work(); }}).front();
}

CommandResult run_command(const std::string& command) {
  const Pipe output = open_pipe();
  std::fflush(nullptr);
  const auto start = Clock::now();
  const pid_t pid = fork();
  if (pid < 0) fail("cannot start a process");
  if (pid == 0) {
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(output.write, STDOUT_FILENO);
    dup2(output.write, STDERR_FILENO);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(output.write);
  CommandResult result;
  result.printed = read_all(output.read);
  close(output.read);
  const Ended ended = wait_for(pid, start);
  result.cost = ended.cost;
  if (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0)
    throw Error(ExitCode::no_result,
                fmt::format("this command failed: {}\n{}", command, last_lines(result.printed)));
  return result;
}

}  // namespace floe
