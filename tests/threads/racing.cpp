// SPDX-License-Identifier: Apache-2.0
// A table that is filled when it is first asked for, without a lock: what a hidden cache would be. Only to be run with
// ThreadSanitizer, which must end it; it counts what it sees.
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

namespace {

class Table {
 public:
  double at(std::size_t i) const {
    if (!values_) values_ = std::make_unique<std::vector<double>>(8, 1.5);
    return (*values_)[i];
  }

 private:
  mutable std::unique_ptr<std::vector<double>> values_;
};

}  // namespace

int main() {
  const Table table;
  double sums[4] = {};
  std::vector<std::thread> threads;
  for (double& sum : sums)
    threads.emplace_back([&table, &sum] {
      for (std::size_t i = 0; i < 8; ++i) sum += table.at(i);
    });
  for (std::thread& thread : threads) thread.join();
  std::printf("no race was seen: %g\n", sums[0] + sums[1] + sums[2] + sums[3]);
}
