// The last few of many things, in their order.
#pragma once

#include <cstddef>
#include <deque>

namespace peterka {

template <class T>
class Latest {
  public:
    explicit Latest(std::size_t capacity) : capacity_(capacity) {}  // 1 or more

    void add(const T& value) {
        if (values_.size() == capacity_) values_.pop_front();
        values_.push_back(value);
    }
    void clear() { values_.clear(); }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] const std::deque<T>& values() const { return values_; }

  private:
    std::size_t capacity_;
    std::deque<T> values_;
};

}  // namespace peterka
