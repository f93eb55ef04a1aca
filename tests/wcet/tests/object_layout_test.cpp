#include "../object_layout.hpp"

#include <gtest/gtest.h>

#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

constexpr const char* kLayoutSource =
    "template <class T, int N> struct Array { T elements[N]; };\n"
    "struct Leaf { uint32_t node[4]; };\n"
    "struct Counters { uint32_t split, merged; };\n"
    "struct Body { static uint32_t made; Array<Leaf, 100> leaf; Counters counters; const uint32_t tick; };\n"
    "uint32_t Body::made;\n"
    "struct Run { Body body; volatile char held; };\n"
    "union Storage { char nothing; Run run; };\n"
    "namespace inside { extern Storage g_storage; Storage g_storage{}; }\n"
    "CASE uint32_t root() { return inside::g_storage.run.body.leaf.elements[3].node[0]; }";

TEST(ObjectLayout, NamesTheParts) {
  const TargetProgram target(std::string(kShorthands) + kLayoutSource);
  const std::optional<ObjectPart> object = read_object(target.path(), "g_storage");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->bytes, 1600u + 8 + 4 + 4);
  const std::vector<PoolUse> pools = list_pools(*object, 64);
  ASSERT_EQ(pools.size(), 4u);
  EXPECT_EQ(pools[0].name, "body.leaf");
  EXPECT_EQ(pools[0].type, "Leaf[]");
  EXPECT_EQ(pools[0].bytes, 1600u);
  EXPECT_EQ(pools[1].name, "body.counters");
  EXPECT_EQ(pools[1].bytes, 8u);
  EXPECT_EQ(pools[2].name, "body.tick");
  EXPECT_EQ(pools[3].name, "held");
}

TEST(ObjectLayout, OfNothing) {
  const TargetProgram target(std::string(kShorthands) + kLayoutSource);
  EXPECT_FALSE(read_object(target.path(), "g_other"));
  EXPECT_FALSE(read_object("/no/such/file", "g_storage"));
}

}  // namespace
}  // namespace palpate::wcet::test
