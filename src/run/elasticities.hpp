// The elasticities that a job requests (elasticity/orbit_elasticity.hpp), of a cell just solved.
#pragma once

#include <cstdint>
#include <vector>

#include "cell/quantities.hpp"
#include "job/job.hpp"

namespace peterka {

class RequestedElasticities {
  public:
    explicit RequestedElasticities(const job::Job& job);

    [[nodiscard]] bool any() const { return !requested_.empty(); }

    // Adds them to the result if it is a periodic orbit. They are those of the full springs, also where the
    // cell leaves their cubic term out.
    void add_to(std::int64_t row, std::int64_t column, cell::CellResult& result) const;

  private:
    const job::Job* job_;
    std::vector<const cell::Quantity*> requested_;
};

}  // namespace peterka
