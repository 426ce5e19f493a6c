// The terminal on which a user watches stderr.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace peterka {

class Terminal {
  public:
    // Ours, or that to which mpirun on this machine forwards our stderr: a rank sees a pipe, although a user
    // watches the other end. Nothing if there is no terminal.
    [[nodiscard]] static std::optional<Terminal> of_stderr();

    Terminal(Terminal&& other) noexcept : descriptor_(std::exchange(other.descriptor_, none)) {}
    Terminal& operator=(Terminal&&) = delete;
    ~Terminal();

    // The current width; 80 if unknown.
    [[nodiscard]] int columns() const;
    // At once, bypassing mpirun, which may hold back incomplete lines (Open MPI 5). What cannot be shown is
    // lost.
    void write(std::string_view text) const;

  private:
    static constexpr int none = -1;
    explicit Terminal(int descriptor) : descriptor_(descriptor) {}

    int descriptor_;
};

}  // namespace peterka
