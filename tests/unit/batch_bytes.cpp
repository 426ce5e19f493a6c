// A cell's numbers depend on the cell and its state alone: not on its slot, its neighbours, the batch's size,
// or the instruction set, as long as the arithmetic is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <random>

#include "batch/cycle_kernel.hpp"
#include "batch_cases.hpp"

namespace peterka::testing {
namespace {

// Everything that a cycle gives, as bytes.
using Bytes = std::vector<unsigned char>;

template <class Number>
void append_to(Bytes& bytes, const Number& number) {
    const auto* from = reinterpret_cast<const unsigned char*>(&number);
    bytes.insert(bytes.end(), from, from + sizeof number);
}

Bytes bytes_of(const batch::BatchedCycleMap& map, std::size_t slot) {
    const auto cycle = map.cycle(slot);
    Bytes bytes;
    for (const double x :
         {cycle.end[0], cycle.end[1], cycle.jacobian(0, 0), cycle.jacobian(0, 1), cycle.jacobian(1, 0),
          cycle.jacobian(1, 1), map.peak_force(slot), map.displacement_bound(slot)}) {
        append_to(bytes, x);
    }
    append_to(bytes, cycle.pattern);
    append_to(bytes, cycle.impacts);
    append_to(bytes, cycle.touched);
    append_to(bytes, cycle.separated);
    return bytes;
}

// The bytes of the cells after some cycles, in a batch of so many slots, cell n in slot places[n].
std::vector<Bytes> run(const std::vector<BatchCell>& cells, std::size_t slots,
                       const std::vector<std::size_t>& places) {
    batch::BatchedCycleMap map(paper_rig(beam_170mm, 1, 0), slots);
    for (std::size_t n = 0; n < cells.size(); ++n) {
        map.place(places[n], cells[n].frequency, cells[n].gap, cells[n].state);
    }
    for (int cycle = 0; cycle < 15; ++cycle) map.advance({.measure = true, .jacobian = true});
    std::vector<Bytes> bytes;
    for (std::size_t n = 0; n < cells.size(); ++n) bytes.push_back(bytes_of(map, places[n]));
    return bytes;
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> places(count);
    std::iota(places.begin(), places.end(), 0U);
    return places;
}

TEST(BatchBytes, DontDependOnSlotOrNeighbours) {
    const auto cells = random_cells(41, 300, 0.5, 4.5, 0, 3);
    const auto expected = run(cells, cells.size(), in_order(cells.size()));
    auto places = in_order(1000);
    std::shuffle(places.begin(), places.end(), std::mt19937(1));
    places.resize(cells.size());
    EXPECT_TRUE(run(cells, 1000, places) == expected);  // with holes
    for (const std::size_t n : {0U, 9U, 77U, 299U}) {
        EXPECT_TRUE(run({cells[n]}, 1, {0}).front() == expected[n]) << "alone";
    }
}

TEST(BatchBytes, DontDependOnWhatElseIsWanted) {
    const auto cells = random_cells(42, 200, 0.5, 4.5, 0, 3);
    const auto rig = paper_rig(beam_170mm, 1, 0);
    batch::BatchedCycleMap plain(rig, cells.size());
    batch::BatchedCycleMap full(rig, cells.size());
    for (std::size_t n = 0; n < cells.size(); ++n) {
        plain.place(n, cells[n].frequency, cells[n].gap, cells[n].state);
        full.place(n, cells[n].frequency, cells[n].gap, cells[n].state);
    }
    int same = 0;
    plain.advance({});
    full.advance({.measure = true, .jacobian = true});
    for (std::size_t n = 0; n < cells.size(); ++n) {
        // what is measured may be what only the twin can measure, whose rounding is its own
        EXPECT_NEAR(plain.state(n)[0], full.state(n)[0], 1e-11);
        same += plain.state(n) == full.state(n) && plain.cycle(n).pattern == full.cycle(n).pattern ? 1 : 0;
    }
    EXPECT_GE(same, 198);
}

class EveryInstructionSet : public ::testing::Test {
  protected:
    ~EveryInstructionSet() override { batch::use_instruction_set(0); }
};

TEST_F(EveryInstructionSet, SameArithmeticGivesTheSameBytes) {
    const auto cells = random_cells(43, 600, 0.5, 4.5, -0.5, 4);
    std::map<std::string, std::vector<Bytes>> by_arithmetic;
    for (const std::int64_t set : batch::instruction_sets()) {
        batch::use_instruction_set(set);
        const auto bytes = run(cells, cells.size(), in_order(cells.size()));
        const auto [known, is_new] = by_arithmetic.try_emplace(std::string(batch::arithmetic()), bytes);
        EXPECT_TRUE(is_new || bytes == known->second) << batch::name_of(set);
    }
    EXPECT_GE(batch::instruction_sets().size(), 1U);
}

TEST_F(EveryInstructionSet, AgreesWithTheTwin) {
    for (const std::int64_t set : batch::instruction_sets()) {
        batch::use_instruction_set(set);
        SCOPED_TRACE(batch::name_of(set));
        const auto c =
            compare_with_twin(paper_rig(beam_170mm, 1, 0), random_cells(44, 500, 0.5, 4.5, 0, 5), 16, 6);
        EXPECT_EQ(c.different_events, c.grazes);
        EXPECT_LT(c.state, 1e-12);
        EXPECT_LT(c.peak_force, 1e-11);
    }
}

}  // namespace
}  // namespace peterka::testing
