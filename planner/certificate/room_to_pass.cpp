#include "planner/certificate/room_to_pass.h"

#include <algorithm>
#include <cmath>

#include "planner/problem/obstacles.h"

namespace regoplan {
namespace {

std::vector<Rock> rocks_in_the_way(const PlanningProblem& problem) {
  std::vector<Rock> rocks = problem.map.rocks();
  std::erase_if(rocks,
                [&](const Rock& rock) { return !in_the_way(problem.map, problem.vehicle, rock); });
  return rocks;
}

double half_track_m(const Vehicle& vehicle) {
  double most = 0;
  for (const WheelMount& wheel : vehicle.wheels) most = std::max(most, std::abs(wheel.y_m));
  return most;
}

}  // namespace

RoomToPass::RoomToPass(const PlanningProblem& problem)
    : map_(problem.map),
      rocks_(rocks_in_the_way(problem)),
      known_(problem.map),
      half_width_m_(std::max(problem.vehicle.body.y_max_m, -problem.vehicle.body.y_min_m)),
      half_track_m_(half_track_m(problem.vehicle)) {}

void RoomToPass::gather(double x_m, double y_m, double half_m) {
  near_.clear();
  const double reach = half_m + half_width_m_ + kPlenty_m;
  rocks_.any_of(x_m - reach, x_m + reach, y_m - reach, y_m + reach, [&](const Rock& rock) {
    near_.push_back({rock.x_m, rock.y_m, rock.radius_m});
    return false;
  });
  // Only contacts must stand on known ground: its edge is seen from nearer than rocks are.
  const double edge_reach = half_m + half_track_m_ + kPlenty_m / 2;
  if (known_.around(x_m, y_m, edge_reach)) return;
  const GridFrame& frame = map_.elevation().frame;
  const double spacing = std::min(frame.cell_width_m, frame.cell_height_m);
  const int parts = static_cast<int>(std::ceil(edge_reach / spacing));
  for (int i = -parts; i <= parts; ++i) {
    for (int k = -parts; k <= parts; ++k) {
      const double x = x_m + i * spacing, y = y_m + k * spacing;
      if (!std::isnan(map_.height_m(x, y)) && map_.soil_index(x, y)) continue;
      near_.push_back({x, y, spacing / 2 + half_track_m_ - half_width_m_});
    }
  }
}

double RoomToPass::room_m(double x_m, double y_m) const {
  double room = kPlenty_m;
  for (const Circle& circle : near_) {
    const double away = std::hypot(circle.x_m - x_m, circle.y_m - y_m);
    room = std::min(room, away - circle.radius_m - half_width_m_);
  }
  return room;
}

RoomToPass::Place RoomToPass::roomiest(double x_m, double y_m, double half_m) {
  gather(x_m, y_m, half_m);
  Place best{x_m, y_m, room_m(x_m, y_m)};
  if (near_.empty()) return best;
  // A pattern search whose steps sum up to no more than half of the side.
  constexpr int kHalvings = 4;
  double step = half_m / 2;
  for (int halving = 0; halving < kHalvings && best.room_m < kPlenty_m; ++halving, step /= 2) {
    const Place from = best;
    for (int i = -1; i <= 1; ++i) {
      for (int k = -1; k <= 1; ++k) {
        const double x = from.x_m + i * step, y = from.y_m + k * step;
        const double room = room_m(x, y);
        if (room > best.room_m) best = {x, y, room};
      }
    }
  }
  return best;
}

}  // namespace regoplan
