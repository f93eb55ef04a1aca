// One image's tick, analysed: the interrupt's handler and all below it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bound.hpp"
#include "loops.hpp"
#include "object_layout.hpp"
#include "profile_shape.hpp"
#include "stack.hpp"

namespace palpate::wcet::timing {

struct PathRow {
  std::string name;
  std::string line;
  double calls = 0;
  double own = 0;
  double with_callees = 0;
};

struct SectionBytes {
  std::string name;
  uint32_t ram = 0;
  uint32_t flash = 0;
};

struct ImageFigures {
  Cycles instructions = 0;                 // with no interrupt around them, as QEMU counts them
  Cycles cycles = 0;                       // of the core's model, with interrupt entry and exit
  Cycles interrupt = 0;                    // those
  std::optional<Cycles> predicted_cycles;  // if backward branches are predicted as taken, where that matters
  std::string model;                       // what it is
  std::vector<PathRow> stages;
  std::vector<PathRow> functions;
  std::vector<PathRow> blocks;  // the hottest
  InterruptedStack stack;
  std::vector<PathRow> stack_chain;  // of the tick; own: bytes
  uint32_t tick_code_bytes = 0;
  std::vector<SectionBytes> sections;
  std::vector<PoolUse> pools;  // of the firmware's static state

  [[nodiscard]] uint32_t ram_bytes() const;
  [[nodiscard]] uint32_t flash_bytes() const;
};

class TimingImage {
 public:
  /// `core`: m4 or m7, a model's name. Throws BadInput and Refusal.
  TimingImage(const std::string& path, const std::string& profile, const std::string& core);
  TimingImage(const TimingImage&) = delete;
  TimingImage(TimingImage&&) = delete;
  TimingImage& operator=(const TimingImage&) = delete;
  TimingImage& operator=(TimingImage&&) = delete;
  ~TimingImage() = default;

  [[nodiscard]] const ProfileShape& profile() const { return profile_; }
  [[nodiscard]] const std::string& core() const { return core_; }
  [[nodiscard]] const ImageFigures& figures() const { return figures_; }
  /// In cycles of the core's model.
  [[nodiscard]] const std::vector<LoopFigures>& loops() const { return loops_; }
  /// The bound if loops had other bounds, by body.
  [[nodiscard]] Cycles cycles_with(const std::map<uint32_t, uint32_t>& limits) const;
  /// What a port's function is called on the worst path.
  [[nodiscard]] double calls_of(const std::string& function) const;

 private:
  void add_path(const BoundAnalysis& analysis);
  void add_memory(const std::string& path);

  const ProfileShape& profile_;
  std::string core_;
  Program program_;
  CallGraph calls_;
  CostModel model_;
  ImageFigures figures_;
  std::vector<LoopFigures> loops_;
};

}  // namespace palpate::wcet::timing
