// XXH3 (64 bits; Y. Collet, xxHash) of data added piece by piece.
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string_view>

namespace peterka::map_file {

class Sum {
  public:
    void add(std::span<const std::byte> bytes) { XXH3_64bits_update(state_.get(), bytes.data(), bytes.size()); }
    void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        add(std::as_bytes(std::span(text)));
    }
    [[nodiscard]] std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

  private:
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_ = [] {
        std::unique_ptr<XXH3_state_t, Free> state(XXH3_createState());
        if (!state || XXH3_64bits_reset(state.get()) != XXH_OK) throw std::bad_alloc();
        return state;
    }();
};

}  // namespace peterka::map_file
