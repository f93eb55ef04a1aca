// The ring's two threads for the thread sanitizer, which ends the program with its report and a failure.
#include <cstdio>

#include "telemetry/ring_threads.hpp"

int main() {
  const palpate::test::RaceResult result = palpate::test::race<8>(200000, 0xffff0000u);
  std::printf("%u taken, %u dropped, %u words torn, %u out of order\n", result.taken, result.dropped,
              result.torn, result.out_of_order);
  const bool holds = result.taken + result.dropped == 200000 && result.torn == 0 && result.out_of_order == 0;
  return holds ? 0 : 1;
}
