// A cell's numbers depend only on the cell and its state: not on its slot, its neighbours, the batch's size,
// or the instruction set, if the arithmetic is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <ostream>
#include <random>

#include "batch/cycle_kernel.hpp"
#include "batch_cases.hpp"
#include "rigid_rig.hpp"

namespace peterka::testing {
namespace {

// All results of a cycle, as bytes.
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
    const auto totals = map.totals(slot);
    for (const double x : {totals.impact_speed, totals.impulse, totals.contact_time, totals.contact_work}) {
        append_to(bytes, x);
    }
    append_to(bytes, totals.impacts);
    append_to(bytes, totals.chatter);
    append_to(bytes, cycle.pattern);
    append_to(bytes, cycle.impacts);
    append_to(bytes, cycle.touched);
    append_to(bytes, cycle.separated);
    return bytes;
}

// A kind of cells for which the batch has a kernel.
struct Kind {
    const char* name;
    scene::Oscillator<double> rig;
    batch::Springs springs;
    friend void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
};
const Kind linear_kind{"linear", cubic_rig(1e-3), batch::Springs::linear};
const Kind split_kind{"split", cubic_rig(1e-3), batch::Springs::split};
const Kind rigid_kind{"rigid", rigid(0.4, 1, 0, 0.004), batch::Springs::linear};

// A batch that also shrinks, grows and hands cells over while it runs.
class Batch {
  public:
    Batch(const std::vector<BatchCell>& cells, std::size_t capacity, const Kind& kind)
        : map_(kind.rig, capacity, 16, kind.springs), cells_(cells) {}

    void add(std::size_t cell) {
        map_.add(cells_[cell].frequency, cells_[cell].gap, cells_[cell].state);
        cell_in_.push_back(cell);
    }
    void remove(std::size_t slot) {
        map_.remove(slot);
        cell_in_[slot] = cell_in_.back();
        cell_in_.pop_back();
    }
    void take(Batch& other, std::size_t slot) {
        const std::size_t cell = other.cell_in_[slot];
        map_.add(cells_[cell].frequency, cells_[cell].gap, other.map_.state(slot));
        cell_in_.push_back(cell);
        other.remove(slot);
    }
    void advance(int cycles) {
        for (int cycle = 0; cycle < cycles; ++cycle) map_.advance();
    }
    // Advances the cells whose events need not wait for others.
    void carry_on() { map_.advance_partly(); }
    [[nodiscard]] bool is_at_end(std::size_t slot) const { return map_.is_at_end(slot); }
    [[nodiscard]] std::size_t cell_in(std::size_t slot) const { return cell_in_[slot]; }
    [[nodiscard]] Bytes bytes(std::size_t slot) const { return bytes_of(map_, slot); }
    [[nodiscard]] std::size_t size() const { return map_.size(); }
    // By cell.
    [[nodiscard]] std::map<std::size_t, Bytes> bytes() const {
        std::map<std::size_t, Bytes> bytes;
        for (std::size_t slot = 0; slot < map_.size(); ++slot) bytes[cell_in_[slot]] = bytes_of(map_, slot);
        return bytes;
    }

  private:
    batch::BatchedCycleMap map_;
    const std::vector<BatchCell>& cells_;
    std::vector<std::size_t> cell_in_;  // by slot
};

// Runs this many cycles, in the given order.
std::map<std::size_t, Bytes> run(const std::vector<BatchCell>& cells, const std::vector<std::size_t>& order,
                                 const Kind& kind) {
    Batch batch(cells, order.size(), kind);
    for (const std::size_t cell : order) batch.add(cell);
    batch.advance(15);
    return batch.bytes();
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    return order;
}

class BatchBytes : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BatchBytes, ::testing::Values(linear_kind, split_kind, rigid_kind));

TEST_P(BatchBytes, DontDependOnSlotOrNeighbours) {
    auto cells = random_cells(41, 300, 0.5, 4.5, 0, 3);
    cells[5].frequency = 1 + 1e-5;  // resonant: handled by the twin
    cells[6].frequency = 1 + 1e-5;
    const auto expected = run(cells, in_order(cells.size()), GetParam());
    auto order = in_order(cells.size());
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    EXPECT_TRUE(run(cells, order, GetParam()) == expected);
    for (const std::size_t n : {0U, 5U, 9U, 77U, 299U}) {
        EXPECT_TRUE(run(cells, {n}, GetParam()).at(n) == expected.at(n)) << "alone";
    }
}

TEST_P(BatchBytes, DontDependOnComingAndGoing) {
    auto cells = random_cells(45, 300, 0.5, 4.5, 0, 3);
    cells[5].frequency = cells[6].frequency = 1 + 1e-5;
    const auto expected = run(cells, in_order(cells.size()), GetParam());
    Batch first(cells, cells.size(), GetParam());
    Batch second(cells, cells.size(), GetParam());
    for (const std::size_t cell : in_order(cells.size())) first.add(cell);
    first.advance(4);
    for (const std::size_t slot : {299U, 5U, 5U, 0U, 17U}) second.take(first, slot);
    first.remove(40);  // a finished cell
    while (second.size() < 120) second.take(first, second.size() % first.size());
    first.advance(11);
    second.advance(11);
    auto bytes = first.bytes();
    bytes.merge(second.bytes());
    EXPECT_EQ(bytes.size(), cells.size() - 1);
    for (const auto& [cell, of_cell] : bytes) EXPECT_TRUE(of_cell == expected.at(cell)) << cell;
}

// Cells reach the end of their cycles at different times, and leave after 15 of them.
TEST_P(BatchBytes, DontDependOnWhichEventsWaitForOthers) {
    auto cells = random_cells(46, 300, 0.5, 4.5, -0.5, 3);
    cells[5].frequency = cells[6].frequency = 1 + 1e-5;
    const auto expected = run(cells, in_order(cells.size()), GetParam());
    Batch batch(cells, 40, GetParam());
    for (const std::size_t cell : in_order(cells.size())) batch.add(cell);
    std::map<std::size_t, Bytes> bytes;
    std::map<std::size_t, int> cycles;
    int waiting = 0;
    for (int round = 0; batch.size() > 0 && round < 1000; ++round) {
        batch.carry_on();
        for (std::size_t slot = batch.size(); slot-- > 0;) {
            if (!batch.is_at_end(slot)) ++waiting;
            if (!batch.is_at_end(slot) || ++cycles[batch.cell_in(slot)] < 15) continue;
            bytes[batch.cell_in(slot)] = batch.bytes(slot);
            batch.remove(slot);
        }
    }
    EXPECT_GT(waiting, 100);
    EXPECT_EQ(bytes.size(), cells.size());
    for (const auto& [cell, of_cell] : bytes) EXPECT_TRUE(of_cell == expected.at(cell)) << cell;
}

class EveryInstructionSet : public ::testing::TestWithParam<Kind> {
  protected:
    ~EveryInstructionSet() override { batch::use_instruction_set(0); }
};

INSTANTIATE_TEST_SUITE_P(Kinds, EveryInstructionSet, ::testing::Values(linear_kind, split_kind, rigid_kind));

TEST_P(EveryInstructionSet, SameArithmeticGivesTheSameBytes) {
    const auto cells = random_cells(43, 600, 0.5, 4.5, -0.5, 4);
    std::map<std::string, std::map<std::size_t, Bytes>> by_arithmetic;
    for (const std::int64_t set : batch::instruction_sets()) {
        batch::use_instruction_set(set);
        const auto bytes = run(cells, in_order(cells.size()), GetParam());
        const auto [known, is_new] = by_arithmetic.try_emplace(std::string(batch::arithmetic()), bytes);
        EXPECT_TRUE(is_new || bytes == known->second) << batch::name_of(set);
    }
    EXPECT_GE(batch::instruction_sets().size(), 1U);
}

TEST_P(EveryInstructionSet, AgreesWithTheTwin) {
    for (const std::int64_t set : batch::instruction_sets()) {
        batch::use_instruction_set(set);
        SCOPED_TRACE(batch::name_of(set));
        const auto c = compare_with_twin(GetParam().rig, random_cells(44, 300, 0.5, 4.5, 0, 5),
                                         {16, GetParam().springs}, 6);
        EXPECT_EQ(c.different_events, c.grazes);
        EXPECT_LT(c.state, 1e-12);
        EXPECT_LT(c.peak_force, 1e-11);
    }
}

}  // namespace
}  // namespace peterka::testing
