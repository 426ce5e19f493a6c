// Base of schema walkers that visit only numbers: it ignores everything else. Derived classes define number()
// and either().
#pragma once

#include <initializer_list>
#include <string_view>

#include "job/key.hpp"

namespace peterka::job {

class NumberWalker {
  public:
    template <typename Choice>
    bool choice(const Key&, Choice&) {
        return true;
    }
    template <typename Complaint>
    void rule(std::initializer_list<std::string_view>, Complaint) {}
};

}  // namespace peterka::job
