// Vectors of doubles, one lane per cell. Included once per instruction set (Highway's foreach_target), like all
// -inl headers here.
//
// Every operation is elementwise and every fused one is written mul_add, so all instruction sets with fused
// operations give bitwise equal results.
#if defined(PETERKA_BATCH_VECTORS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_VECTORS_INL_HPP
#undef PETERKA_BATCH_VECTORS_INL_HPP
#else
#define PETERKA_BATCH_VECTORS_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "batch/lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<double>;
using IndexTag = hn::ScalableTag<std::int64_t>;
using PatternTag = hn::ScalableTag<std::uint64_t>;

// A pair of vectors: two chains of operations in flight hide each other's latency (gains a quarter).
template <class One>
struct Pair {
    One a, b;
};
using V = Pair<hn::Vec<Tag>>;
using Mask = Pair<hn::Mask<Tag>>;
using Index = Pair<hn::Vec<IndexTag>>;
using Pattern = Pair<hn::Vec<PatternTag>>;

HWY_INLINE std::size_t half() {
    return hn::Lanes(Tag());
}
HWY_INLINE std::size_t width() {
    return 2 * half();
}

// Rounded up to whole vectors.
HWY_INLINE std::size_t in_vectors(std::size_t lanes) {
    return (lanes + width() - 1) / width() * width();
}

HWY_INLINE V all(double x) {
    const auto one = hn::Set(Tag(), x);
    return {one, one};
}
// Lets the same code serve a number shared by all lanes and one number per lane.
HWY_INLINE V all(V x) {
    return x;
}
HWY_INLINE V load(const double* from) {
    return {hn::LoadU(Tag(), from), hn::LoadU(Tag(), from + half())};
}
HWY_INLINE Index load(const std::int64_t* from) {
    return {hn::LoadU(IndexTag(), from), hn::LoadU(IndexTag(), from + half())};
}
HWY_INLINE Pattern load(const std::uint64_t* from) {
    return {hn::LoadU(PatternTag(), from), hn::LoadU(PatternTag(), from + half())};
}
HWY_INLINE void store(V x, double* to) {
    hn::StoreU(x.a, Tag(), to);
    hn::StoreU(x.b, Tag(), to + half());
}
HWY_INLINE void store(Index x, std::int64_t* to) {
    hn::StoreU(x.a, IndexTag(), to);
    hn::StoreU(x.b, IndexTag(), to + half());
}
HWY_INLINE void store(Pattern x, std::uint64_t* to) {
    hn::StoreU(x.a, PatternTag(), to);
    hn::StoreU(x.b, PatternTag(), to + half());
}
#if HWY_TARGET == HWY_AVX2
// Single loads take half as long as the hardware gather.
HWY_INLINE hn::Vec<Tag> gather(const double* from, hn::Vec<IndexTag> lanes) {
    const __m128i low = _mm256_castsi256_si128(lanes.raw);
    const __m128i high = _mm256_extracti128_si256(lanes.raw, 1);
    return hn::Vec<Tag>{_mm256_setr_pd(from[_mm_cvtsi128_si64(low)], from[_mm_extract_epi64(low, 1)],
                                       from[_mm_cvtsi128_si64(high)], from[_mm_extract_epi64(high, 1)])};
}
#else
HWY_INLINE hn::Vec<Tag> gather(const double* from, hn::Vec<IndexTag> lanes) {
    return hn::GatherIndex(Tag(), from, lanes);
}
#endif
HWY_INLINE V gather(const double* from, Index lanes) {
    return {gather(from, lanes.a), gather(from, lanes.b)};
}
HWY_INLINE Pattern gather(const std::uint64_t* from, Index lanes) {
    return {hn::GatherIndex(PatternTag(), from, lanes.a), hn::GatherIndex(PatternTag(), from, lanes.b)};
}
HWY_INLINE void scatter(V x, double* to, Index lanes) {
    hn::ScatterIndex(x.a, Tag(), to, lanes.a);
    hn::ScatterIndex(x.b, Tag(), to, lanes.b);
}
HWY_INLINE void scatter(Pattern x, std::uint64_t* to, Index lanes) {
    hn::ScatterIndex(x.a, PatternTag(), to, lanes.a);
    hn::ScatterIndex(x.b, PatternTag(), to, lanes.b);
}
// The numbers of a vector one by one.
template <class Number>
class Numbers {
  public:
    HWY_INLINE explicit Numbers(V x) { store(x, numbers_); }
    HWY_INLINE explicit Numbers(Index x) { store(x, numbers_); }
    HWY_INLINE Number operator[](int n) const { return numbers_[n]; }

  private:
    alignas(64) Number numbers_[widest_vector];
};
Numbers(V)->Numbers<double>;
Numbers(Index)->Numbers<std::int64_t>;
// first, first + 1, ...
HWY_INLINE Index index_from(std::size_t first) {
    const auto lowest = hn::Add(hn::Iota(IndexTag(), 0), hn::Set(IndexTag(), static_cast<std::int64_t>(first)));
    return {lowest, hn::Add(lowest, hn::Set(IndexTag(), static_cast<std::int64_t>(half())))};
}
// From integer-valued doubles.
HWY_INLINE Index index_of(V numbers) {
    return {hn::ConvertTo(IndexTag(), numbers.a), hn::ConvertTo(IndexTag(), numbers.b)};
}
HWY_INLINE Mask first(std::size_t count) {
    return {hn::FirstN(Tag(), count), hn::FirstN(Tag(), count > half() ? count - half() : 0)};
}

// One bit per lane, the first lane's lowest.
HWY_INLINE std::uint64_t bits(Mask which) {
    std::uint8_t bytes[2][8] = {};
    hn::StoreMaskBits(Tag(), which.a, bytes[0]);
    hn::StoreMaskBits(Tag(), which.b, bytes[1]);
    return bytes[0][0] | std::uint64_t{bytes[1][0]} << half();
}

HWY_INLINE V operator+(V x, V y) {
    return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)};
}
HWY_INLINE V operator-(V x, V y) {
    return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)};
}
HWY_INLINE V operator*(V x, V y) {
    return {hn::Mul(x.a, y.a), hn::Mul(x.b, y.b)};
}
HWY_INLINE V operator*(double x, V y) {
    return all(x) * y;
}
HWY_INLINE V operator/(V x, V y) {
    return {hn::Div(x.a, y.a), hn::Div(x.b, y.b)};
}
HWY_INLINE V operator/(double x, V y) {
    return all(x) / y;
}
HWY_INLINE V operator-(V x) {
    return {hn::Neg(x.a), hn::Neg(x.b)};
}
HWY_INLINE V mul_add(V x, V y, V z) {
    return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)};
}
HWY_INLINE V mul_sub(V x, V y, V z) {
    return {hn::MulSub(x.a, y.a, z.a), hn::MulSub(x.b, y.b, z.b)};
}
// z - x y, and -x y - z
HWY_INLINE V neg_mul_add(V x, V y, V z) {
    return {hn::NegMulAdd(x.a, y.a, z.a), hn::NegMulAdd(x.b, y.b, z.b)};
}
HWY_INLINE V neg_mul_sub(V x, V y, V z) {
    return {hn::NegMulSub(x.a, y.a, z.a), hn::NegMulSub(x.b, y.b, z.b)};
}
HWY_INLINE V min(V x, V y) {
    return {hn::Min(x.a, y.a), hn::Min(x.b, y.b)};
}
HWY_INLINE V max(V x, V y) {
    return {hn::Max(x.a, y.a), hn::Max(x.b, y.b)};
}
HWY_INLINE V abs(V x) {
    return {hn::Abs(x.a), hn::Abs(x.b)};
}
HWY_INLINE V sqrt(V x) {
    return {hn::Sqrt(x.a), hn::Sqrt(x.b)};
}
HWY_INLINE V floor(V x) {
    return {hn::Floor(x.a), hn::Floor(x.b)};
}
HWY_INLINE V round(V x) {
    return {hn::Round(x.a), hn::Round(x.b)};
}

HWY_INLINE Mask operator<(V x, V y) {
    return {hn::Lt(x.a, y.a), hn::Lt(x.b, y.b)};
}
HWY_INLINE Mask operator>(V x, V y) {
    return {hn::Gt(x.a, y.a), hn::Gt(x.b, y.b)};
}
HWY_INLINE Mask operator<=(V x, V y) {
    return {hn::Le(x.a, y.a), hn::Le(x.b, y.b)};
}
HWY_INLINE Mask operator>=(V x, V y) {
    return {hn::Ge(x.a, y.a), hn::Ge(x.b, y.b)};
}
HWY_INLINE Mask operator==(V x, V y) {
    return {hn::Eq(x.a, y.a), hn::Eq(x.b, y.b)};
}
HWY_INLINE Mask operator!=(V x, V y) {
    return {hn::Ne(x.a, y.a), hn::Ne(x.b, y.b)};
}
HWY_INLINE Mask operator&(Mask x, Mask y) {
    return {hn::And(x.a, y.a), hn::And(x.b, y.b)};
}
HWY_INLINE Mask operator|(Mask x, Mask y) {
    return {hn::Or(x.a, y.a), hn::Or(x.b, y.b)};
}
HWY_INLINE Mask operator~(Mask x) {
    return {hn::Not(x.a), hn::Not(x.b)};
}
HWY_INLINE Mask every() {
    return first(width());
}
HWY_INLINE Mask none() {
    return first(0);
}
HWY_INLINE bool any(Mask which) {
    return !hn::AllFalse(Tag(), which.a) || !hn::AllFalse(Tag(), which.b);
}
HWY_INLINE bool everywhere(Mask which) {
    return hn::AllTrue(Tag(), which.a) && hn::AllTrue(Tag(), which.b);
}
HWY_INLINE V choose(Mask which, V yes, V no) {
    return {hn::IfThenElse(which.a, yes.a, no.a), hn::IfThenElse(which.b, yes.b, no.b)};
}
HWY_INLINE Pattern choose(Mask which, Pattern yes, Pattern no) {
    return {hn::IfThenElse(hn::RebindMask(PatternTag(), which.a), yes.a, no.a),
            hn::IfThenElse(hn::RebindMask(PatternTag(), which.b), yes.b, no.b)};
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
