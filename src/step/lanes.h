#pragma once

#include <algorithm>
#include <cstddef>

#include "mesh/mesh_data.h"

namespace remodel {

// Several triangles side by side: loops over the lanes compile to vector instructions.
class Lanes {
 public:
  static constexpr std::size_t count = 8;
  struct Rows {
    double ax[count], ay[count], bx[count], by[count], cx[count], cy[count], scales[count];
    double centre_x[count], centre_y[count], inside[count], outside[count], spare[count];
  };

  template <class Place>  // with a point and a length scale, as a Vertex has
  void load(std::size_t lane, const Place& a, const Place& b, const Place& c) {
    rows_.ax[lane] = a.point.x, rows_.ay[lane] = a.point.y;
    rows_.bx[lane] = b.point.x, rows_.by[lane] = b.point.y;
    rows_.cx[lane] = c.point.x, rows_.cy[lane] = c.point.y;
    rows_.scales[lane] = a.length_scale + b.length_scale + c.length_scale;
  }
  // The same bits as certified_circle(a, b, c), and the same answer as is_good() for its radius.
  void judge(const QualityBounds& bounds);
  Circle circle(std::size_t lane) const {
    return {{rows_.centre_x[lane], rows_.centre_y[lane]}, rows_.inside[lane], rows_.outside[lane]};
  }
  bool good(std::size_t lane) const { return rows_.spare[lane] >= 0.0; }  // uncertain ones: -infinity

 private:
  Rows rows_;
};

}  // namespace remodel
