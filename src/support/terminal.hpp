// Whether somebody watches what we print on stderr.
#pragma once

namespace peterka {

// True on a terminal, and also where mpirun on this machine hands our stderr on to its own terminal: a rank
// then sees a pipe, although a person sits at the other end.
[[nodiscard]] bool stderr_is_watched();

// Of that terminal, as wide as it is now; 80 where it is not known.
[[nodiscard]] int stderr_columns();

}  // namespace peterka
