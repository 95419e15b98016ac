#include "drive_diagnosis/fit/likely_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
/// Steps by which edges are tried, and how far about the likeliest so far; windows.
constexpr double kCoarse = 0.25, kReach = 1, kFine = 0.05, kNear = 0.2;
/// Angles at which borders are crossed: those tried first, and steps about the likeliest so far.
constexpr double kMost_rad = 60 * kDegree, kCoarse_rad = 20 * kDegree, kFine_rad = 7 * kDegree;

/// Edges that were tried, and by how many nats they and what they leave are unlikely.
struct Tried {
  WindowZone zone;
  double nats;
};

/// By how many nats less likely it is to come onto a border at this slant than straight: the chance
/// of an angle goes with its cosine, that of its tangent with the cubed cosine.
double slant_nats(double slant) {
  return 1.5 * std::log1p(slant * slant);
}

/// A window, and which zone each of its wheels is in all along: edges that leave those where they
/// are leave the window as it is.
using WindowOverZones = std::pair<std::size_t, std::vector<int>>;

class EdgeSearch {
 public:
  EdgeSearch(const FittedWindows& windows, std::vector<WindowZone> zones,
             const std::stop_token& stop)
      : windows_(windows),
        zones_(std::move(zones)),
        stop_(stop),
        within_reach_(windows.comparison.touching(
            {windows.comparison.widened(slanted_most(zones_.back()), kReach + kNear)})) {
    // Windows that balance now have to with other edges too.
    otherwise_ = windows.predicted;
    const Eigen::MatrixXd now =
        predicted(Eigen::MatrixXd::Constant(otherwise_.rows(), otherwise_.cols(), kNothing));
    for (Eigen::Index w = 0; w < now.rows(); ++w) {
      if (now.row(w).allFinite()) otherwise_.row(w).setConstant(kNothing);
    }
  }

  /// All about the present edges.
  void try_about(double step, double reach) {
    const WindowZone middle = zones_.back();
    std::vector<WindowZone> places;
    for (double from = -reach; from <= reach; from += step) {
      for (double to = -reach; to <= reach; to += step) {
        WindowZone& place = places.emplace_back(middle);
        place.begins += from;
        place.ends += to;
        if (!is_possible(place)) places.pop_back();
      }
    }
    try_all(places);
  }

  /// All slants of one border, then of the other, by `step` and no farther than `reach` from the
  /// present one.
  void try_slants(double step_rad, double reach_rad) {
    for (double WindowZone::*slant : {&WindowZone::begins_slant, &WindowZone::ends_slant}) {
      const double about_rad = std::atan(zones_.back().*slant);
      std::vector<WindowZone> places;
      for (double off_rad = -reach_rad; off_rad <= reach_rad + 1e-9; off_rad += step_rad) {
        if (std::abs(about_rad + off_rad) > kMost_rad + 1e-9) continue;
        WindowZone& place = places.emplace_back(zones_.back());
        place.*slant = std::tan(about_rad + off_rad);
      }
      try_all(places);
    }
  }

  LikelyEdges likeliest() const {
    const WindowZone& zone = zones_.back();
    const WindowZone widest = windows_.comparison.widened(zone, kEdgeErr);
    LikelyEdges edges{.at = {.begins = zone.begins,
                             .ends = zone.ends,
                             .begins_slant = zone.begins_slant,
                             .ends_slant = zone.ends_slant},
                      .begins_ci95 = {widest.begins, zone.begins + kEdgeErr},
                      .ends_ci95 = {zone.ends - kEdgeErr, widest.ends}};
    const auto take = [](std::array<double, 2>& range, double value) {
      range = {std::min(range[0], value), std::max(range[1], value)};
    };
    double least = std::numeric_limits<double>::infinity();
    for (const Tried& one : tried_) least = std::min(least, one.nats);
    for (const Tried& one : tried_) {
      constexpr double kWithin_nats = 1.92;  // half of chi squared, 95 %
      if (one.nats > least + kWithin_nats) continue;
      take(edges.begins_ci95, one.zone.begins);
      take(edges.ends_ci95, one.zone.ends);
    }
    return edges;
  }

 private:
  void try_all(const std::vector<WindowZone>& places) {
    predict_in(places);
    for (const WindowZone& place : places) weigh(place);
    if (tried_.empty()) return;
    zones_.back() = std::ranges::min_element(tried_, {}, &Tried::nats)->zone;
  }

  Eigen::MatrixXd predicted(const Eigen::MatrixXd& otherwise) const {
    return windows_.comparison.predicted(within_reach_, windows_.deviation, zones_, otherwise,
                                         stop_);
  }

  WindowQuestion with(const WindowZone& place) const {
    WindowQuestion question{windows_.deviation, zones_};
    question.zones.back() = place;
    return question;
  }

  /// Predicts what windows are with the zone at any of these places, each window once.
  void predict_in(const std::vector<WindowZone>& places) {
    std::vector<std::pair<std::size_t, WindowQuestion>> asked;
    std::vector<WindowOverZones> as;
    std::set<WindowOverZones> is_asked;
    for (const WindowZone& place : places) {
      const WindowQuestion question = with(place);
      for (const std::size_t w : within_reach_) {
        const WindowOverZones over{w, windows_.comparison.zones_under_wheels(w, question)};
        if (known_.contains(over) || !is_asked.insert(over).second) continue;
        asked.emplace_back(w, question);
        as.push_back(over);
      }
    }
    std::vector<std::optional<Eigen::VectorXd>> values =
        windows_.comparison.predicted_each(asked, stop_);
    for (std::size_t i = 0; i < as.size(); ++i) known_[as[i]] = std::move(values[i]);
  }

  void weigh(const WindowZone& place) {
    const WindowQuestion question = with(place);
    Eigen::MatrixXd there = otherwise_;
    for (const std::size_t w : within_reach_) {
      const auto& values = known_.at({w, windows_.comparison.zones_under_wheels(w, question)});
      if (values) there.row(static_cast<Eigen::Index>(w)) = *values;
    }
    if (!there.allFinite()) return;
    tried_.push_back({place, windows_.noise.nats(windows_.measured - there) +
                                 slant_nats(place.begins_slant) + slant_nats(place.ends_slant)});
  }

  bool is_possible(const WindowZone& place) const {
    constexpr double kLeast = 1;
    return place.ends - place.begins >= kLeast && is_free(place.begins, place.ends);
  }

  /// Whether windows follow each other there and lie in no other zone.
  bool is_free(double begins, double ends) const {
    if (begins < 0 || ends > static_cast<double>(windows_.comparison.size())) return false;
    for (auto w = static_cast<std::size_t>(begins) + 1; static_cast<double>(w) < ends; ++w) {
      if (!windows_.comparison.consecutive(w)) return false;
    }
    return std::none_of(zones_.begin(), zones_.end() - 1, [&](const WindowZone& other) {
      return begins < other.ends && ends > other.begins;
    });
  }

  const FittedWindows& windows_;
  std::vector<WindowZone> zones_;
  const std::stop_token& stop_;
  WindowSet within_reach_;
  Eigen::MatrixXd otherwise_;  ///< of windows that do not balance, and that are not predicted anew
  std::map<WindowOverZones, std::optional<Eigen::VectorXd>> known_;  ///< nothing: no balance
  std::vector<Tried> tried_;
};

}  // namespace

WindowZone slanted_most(WindowZone zone) {
  zone.begins_slant = zone.ends_slant = std::tan(kMost_rad);
  return zone;
}

LikelyEdges likely_edges(const FittedWindows& windows, std::vector<WindowZone> zones,
                         const std::stop_token& stop) {
  EdgeSearch search(windows, std::move(zones), stop);
  search.try_about(kCoarse, kReach);
  search.try_slants(kCoarse_rad, 2 * kMost_rad);
  search.try_about(kFine, kNear);
  search.try_slants(kFine_rad, kFine_rad);
  return search.likeliest();
}

}  // namespace regoplan
