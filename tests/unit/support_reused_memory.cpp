// Returned blocks are reused, and never by two owners at a time.
#include "support/reused_memory.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

namespace peterka {
namespace {

TEST(ReusedMemory, BlocksKeepWhatIsWrittenIntoThem) {
    struct Block {
        unsigned char* bytes;
        std::size_t size;
        unsigned char mark;
    };
    std::vector<Block> blocks;
    std::mt19937 random(7);
    for (int n = 0; n < 20000; ++n) {
        if (blocks.size() < 50 || random() % 2 == 0) {
            const std::size_t size = 1 + random() % (random() % 10 == 0 ? 20000 : 600);
            const auto mark = static_cast<unsigned char>(random());
            auto* bytes = static_cast<unsigned char*>(ReusedMemory::take(size));
            std::memset(bytes, mark, size);
            blocks.push_back({bytes, size, mark});
            continue;
        }
        std::swap(blocks[random() % blocks.size()], blocks.back());
        const Block block = blocks.back();
        blocks.pop_back();
        bool intact = true;
        for (std::size_t i = 0; i < block.size; ++i) intact &= block.bytes[i] == block.mark;
        ASSERT_TRUE(intact) << n;
        ReusedMemory::give_back(block.bytes, block.size);
    }
    for (const Block& block : blocks) ReusedMemory::give_back(block.bytes, block.size);
}

// A block is handed on only to who wants no more than it has.
TEST(ReusedMemory, ALargerBlockIsAnother) {
    for (const std::size_t size : {64, 128, 640}) {
        void* small = ReusedMemory::take(size);
        ReusedMemory::give_back(small, size);
        void* large = ReusedMemory::take(size + 1);
        EXPECT_NE(large, small) << size;
        ReusedMemory::give_back(large, size + 1);
    }
}

}  // namespace
}  // namespace peterka
