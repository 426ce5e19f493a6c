// The terminal at which somebody watches what we print on stderr.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace peterka {

class Terminal {
  public:
    // Ours, or that to which mpirun on this machine hands our stderr on: a rank sees a pipe, although a person
    // sits at the other end. Nothing where nobody watches.
    [[nodiscard]] static std::optional<Terminal> of_stderr();

    Terminal(Terminal&& other) noexcept : descriptor_(std::exchange(other.descriptor_, none)) {}
    Terminal& operator=(Terminal&&) = delete;
    ~Terminal();

    // As it is now; 80 where it is not known.
    [[nodiscard]] int columns() const;
    // At once, past mpirun, which may keep back what isn't a whole line (Open MPI 5). What can't be shown is
    // lost.
    void write(std::string_view text) const;

  private:
    static constexpr int none = -1;
    explicit Terminal(int descriptor) : descriptor_(descriptor) {}

    int descriptor_;
};

}  // namespace peterka
