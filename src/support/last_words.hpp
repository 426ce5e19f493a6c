// A message and exit code 70 where the program would end without: on an uncaught exception, even before main()
// or in a noexcept function, and on a library's own exit(), which HDF5 1.10 calls if it has no memory for an
// identifier.
#pragma once

namespace peterka {

// While one exists, exit() is attributed to a library, and ends the program with a message.
class LastWords {
  public:
    LastWords();
    ~LastWords() { are_said(); }
    LastWords(const LastWords&) = delete;
    LastWords& operator=(const LastWords&) = delete;

    // From here on exit() is the program's own.
    static void are_said();
};

}  // namespace peterka
