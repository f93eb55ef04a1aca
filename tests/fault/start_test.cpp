// A model whose container is damaged: the device says so and stands still with no torque, whatever its user
// does; a new start with the whole one helps.
#include <gtest/gtest.h>

#include "palpate/firmware/model_container.hpp"
#include "recovery.hpp"
#include "support/containers.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::fault {
namespace {

test::File whole_container() {
  test::MemorySink sink;
  EXPECT_EQ(firmware::write_model(sink, body_model(), test::bytes_of(std::string("touch"))),
            container::WriteStatus::kDone);
  return sink.file;
}

/// As the firmware's main does; false: the model was refused.
bool start_from(const test::File& file, Cycle& cycle) {
  firmware::CycleModel model{};
  const container::Finding finding = firmware::read_model(test::bytes_of(file), Small::kMaxLevel, model);
  if (!finding.is_done()) {
    firmware::refuse_model(cycle);
    return false;
  }
  return firmware::start(cycle, model) == Status::kDone && firmware::guard_device(cycle, device_parameters());
}

void expect_no_torque(Loop& loop, uint32_t ticks) {
  for (uint32_t i = 0; i < ticks; ++i) {
    loop.advance();
    ASSERT_FALSE(loop.has_torque());
    ASSERT_EQ(loop.state(), safety::State::kFault);
    ASSERT_TRUE(loop.cycle.safety.raised.has(safety::Condition::kCorruptModel));
  }
}

TEST(FaultAtStart, AByteThatIsWrongKeepsTheMotorsStill) {
  const test::File whole = whole_container();
  test::Random random(7);
  const uint32_t flips = test::in_soak(8 * static_cast<uint32_t>(whole.size()), 200u);
  for (uint32_t i = 0; i < flips; ++i) {
    test::File damaged = whole;
    const uint32_t bit = test::in_soak(i, random.below(8 * static_cast<uint32_t>(whole.size())));
    damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ (1u << bit % 8));
    Loop loop;
    ASSERT_FALSE(start_from(damaged, loop.cycle)) << "bit " << bit;
    ASSERT_NO_FATAL_FAILURE(expect_no_torque(loop, i % 50 == 0 ? kScenarioTicks : 20u)) << "bit " << bit;
  }
}

TEST(FaultAtStart, TheWholeModelIsTheSame) {
  Loop loop;
  Loop from_file;
  ASSERT_TRUE(start_from(whole_container(), from_file.cycle));
  for (uint32_t i = 0; i < 800; ++i) {
    loop.advance();
    from_file.advance();
  }
  EXPECT_EQ(state_hash(from_file.cycle), state_hash(loop.cycle));
}

TEST(FaultAtStart, ANewStartWithTheWholeModelHelps) {
  test::File damaged = whole_container();
  damaged[100] = static_cast<uint8_t>(damaged[100] ^ 1u);
  Loop loop;
  const PoolsInUse at_rest = pools_in_use(loop.cycle);
  ASSERT_FALSE(start_from(damaged, loop.cycle));
  ASSERT_NO_FATAL_FAILURE(expect_no_torque(loop, 300));
  ASSERT_TRUE(start_from(whole_container(), loop.cycle));
  Checks checks;
  Recovery recovery(loop, checks);
  EXPECT_EQ(recovery.run(false), "");
  EXPECT_EQ(recovery.come_to_rest(at_rest), "");
}

}  // namespace
}  // namespace palpate::fault
