#include "map_file/attractor_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

namespace peterka::map_file {
namespace {

constexpr std::int64_t room_of_point = 4;
constexpr double gap_of_points = 0.5;

// Orbits with these periods, and one touch on the first.
attractors::PointAttractors point_of(const std::vector<int>& periods) {
    attractors::PointAttractors point{.count = static_cast<std::int32_t>(periods.size()), .gap = gap_of_points};
    for (std::size_t i = 0; i < periods.size(); ++i) {
        regime::SteadyMotion& motion = point.motions.emplace_back(room_of_point);
        for (int n = 0; n < periods[i]; ++n)
            motion.stroboscopic.add({10.0 * static_cast<double>(i) + n, 100.0 + n});
        if (i == 0) motion.touches.add({std::numbers::pi / 2, 3.0});
    }
    return point;
}

template <class Number>
std::vector<Number> numbers_at(const std::vector<std::byte>& bytes, std::size_t& at, std::size_t count) {
    std::vector<Number> numbers(count);
    std::memcpy(numbers.data(), bytes.data() + at, count * sizeof(Number));
    at += count * sizeof(Number);
    return numbers;
}

TEST(AttractorSamples, OfAPointShareItsRoomThoseWithLargeSharesFirst) {
    const std::vector<attractors::PointAttractors> points{point_of({4, 1}), point_of({}), point_of({1, 4})};
    constexpr std::int64_t rows = 2;
    const std::vector<std::byte> bytes = attractor_sample_bytes(points, rows, room_of_point);
    const std::size_t row = points.size() * room_of_point;
    ASSERT_EQ(bytes.size(), rows * row * 2 * (4 + 8 + 8));
    std::size_t at = 0;
    const auto attractor = numbers_at<std::int32_t>(bytes, at, rows * row);
    const std::vector<std::int32_t> expected{0, 0, 1, -1, -1, -1, -1, -1, 0, 1, 1, 1};
    for (std::size_t i = 0; i < attractor.size(); ++i) EXPECT_EQ(attractor[i], expected[i % row]) << i;
    const auto displacement = numbers_at<double>(bytes, at, rows * row);
    const auto velocity = numbers_at<double>(bytes, at, rows * row);
    for (std::size_t i = 0; i < attractor.size(); ++i) {
        EXPECT_EQ(std::isnan(displacement[i]), attractor[i] < 0) << i;
        EXPECT_EQ(std::isnan(velocity[i]), attractor[i] < 0) << i;
    }
    EXPECT_EQ(displacement[1], 1 + gap_of_points);
    EXPECT_EQ(velocity[1], 101);
    EXPECT_EQ(displacement[2], 10 + gap_of_points);
    const auto struck = numbers_at<std::int32_t>(bytes, at, rows * row);
    EXPECT_EQ(struck[0], 0);
    EXPECT_EQ(struck[1], -1);
    EXPECT_DOUBLE_EQ(numbers_at<double>(bytes, at, rows * row)[0], gap_of_points + 1);
}

}  // namespace
}  // namespace peterka::map_file
