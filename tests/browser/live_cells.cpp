// The page's engine without a browser: reads cells, one a line, as the numbers of peterka_cell(), and prints
// the numbers of peterka_answer() for each, to the last bit.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

#include "page/interface.hpp"

int main() {
    using namespace peterka::page;
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream numbers(line);
        double* cell = peterka_cell();
        for (std::string number; numbers >> number;) *cell++ = std::stod(number);
        peterka_begin(1);
        while (peterka_advance(100) == 0) {
        }
        const double* answer = peterka_answer();
        for (int i = 0; i < answer_numbers; ++i) std::printf("%.17g ", answer[i]);
        std::printf("\n");
    }
    return 0;
}
