// The last few of many values, in their order (a ring buffer).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace peterka {

template <class T>
class Latest {
  public:
    explicit Latest(std::size_t capacity) : capacity_(capacity) {}  // 1 or more

    void add(const T& value) {
        if (values_.size() < capacity_) {
            values_.push_back(value);
        } else {
            values_[oldest_] = value;
            oldest_ = (oldest_ + 1) % capacity_;
        }
    }
    void clear() {
        values_.clear();
        oldest_ = 0;
    }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::vector<T> values() const {
        std::vector<T> in_order = values_;
        std::rotate(in_order.begin(), in_order.begin() + static_cast<std::ptrdiff_t>(oldest_), in_order.end());
        return in_order;
    }

  private:
    std::size_t capacity_;
    std::size_t oldest_ = 0;  // once it is full
    std::vector<T> values_;   // empty without an allocation: a sweep has two for each of its points
};

}  // namespace peterka
