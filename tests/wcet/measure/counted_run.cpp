#include "counted_run.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "support/temporary_folder.hpp"

namespace palpate::wcet {
namespace {

std::string contents_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Its exit status; both of its outputs go to a file.
int run(const std::vector<std::string>& command, const std::string& output) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, 1, 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw RunFailed("can't run " + command[0] + ": " + std::strerror(error));
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw RunFailed("lost " + command[0]);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Counts run_counted(const std::vector<std::string>& command, const std::string& plugin, const Plan& plan) {
  const palpate::test::TemporaryFolder folder;
  const std::string plan_path = folder / "plan";
  const std::string counts_path = folder / "counts";
  const std::string output_path = folder / "output";
  std::ofstream plan_file(plan_path);
  write_plan(plan, plan_file);
  plan_file.close();
  std::vector<std::string> whole = command;
  whole.push_back("-plugin");
  whole.push_back(plugin + ",plan=" + plan_path + ",counts=" + counts_path);
  const int status = run(whole, output_path);
  const std::string output = contents_of(output_path);
  if (status != 0)
    throw RunFailed(command[0] + " ended with status " + std::to_string(status) + ":\n" + output);
  std::ifstream counts_file(counts_path);
  if (!counts_file) throw RunFailed("QEMU ran without the plugin:\n" + output);
  return read_counts(counts_file);
}

}  // namespace palpate::wcet
