// Words and exit code 70 where the program would end without: by an exception that nobody catches, even before
// main() or in a function that must not throw, and by a library's own exit(), as HDF5 1.10 calls it where it
// has no memory for an identifier.
#pragma once

namespace peterka {

// While one lives, exit() is a library's, and ends the program in words.
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
