// Independent pieces of work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace palpate::sim {

/// Prints a line of one piece of work; lines of several do not mix.
void print_line(const std::string& line);

/// work(item) of each item, in their order. The first exception ends it: no further item is started, and it
/// is thrown here.
template <class Item, class Work>
auto in_parallel(const std::vector<Item>& items, Work&& work) {
  using Result = decltype(work(items.front()));
  std::vector<std::optional<Result>> results(items.size());
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&] {
    for (std::size_t i = next++; i < items.size(); i = next++) {
      try {
        results[i].emplace(work(items[i]));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(failing);
        if (!failure) failure = std::current_exception();
        next = items.size();
      }
    }
  };
  std::vector<std::thread> threads;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t i = 1; i < std::min(cores, items.size()); ++i) threads.emplace_back(run);
  run();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  std::vector<Result> all;
  all.reserve(items.size());
  for (auto& result : results) all.push_back(std::move(*result));
  return all;
}

}  // namespace palpate::sim
