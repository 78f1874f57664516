// SPDX-License-Identifier: Apache-2.0
#include "search/neighbor_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/concurrent_walk.hpp"
#include "parallel/parallel_for.hpp"
#include "search/search.hpp"

namespace riis {
namespace {

constexpr std::int64_t nodes_per_range = NeighborScratch::nodes_per_range, balls_per_block = 16;
// If there are fewer balls than these numbers, one thread is used, because each part of the search then takes only a millisecond
// or two.
constexpr std::int64_t few_balls = 256, few_large_balls = 64;

template <class Distances>
class NeighborSearch {
 public:
  NeighborSearch(const SearchRequest &request, const Distances &distances, NeighborScratch &scratch, FoundNodes &found)
      : request_(request),
        nodes_(request.mesh.points()),
        adjacency_(*request.mesh.adjacency()),
        distances_(distances),
        limit_(request.distance_limit),
        found_(found),
        walked_(scratch) {
    found.prepare(request.n_threads, request.ties);
    walked_.prepare(nodes_.n, request.n_threads);
  }

  // Adds a node at which the walk starts. If a node is added repeatedly, it is queried only once.
  void begin_at(std::int64_t node) {
    if (!request_.is_masked_out(node) && walked_.claim(node)) view(walked_.queue)[n_queued_++] = node;
  }

  // Queries the nodes at which the walk starts. From each node within the limit, the walk goes on to the node's neighbours.
  void walk(int n_threads) {
    std::vector<Range> &ranges = walked_.ranges;
    ranges.clear();
    for (std::int64_t i = 0; i < n_queued_; i += nodes_per_range)
      ranges.push_back({i, std::min(i + nodes_per_range, n_queued_.load())});
    const int n_ran = concurrent_walk(ranges, n_threads, [&](const Range &range, const auto &add, int thread) {
      std::vector<std::int64_t> &next = view(walked_.threads)[thread].next;
      next.clear();
      const auto hand_on = [&] {
        const auto n = view(next).size();
        if (n == 0) return;
        const std::int64_t begin = n_queued_.fetch_add(n, std::memory_order_relaxed);
        std::copy(next.begin(), next.end(), walked_.queue.begin() + begin);
        next.clear();
        add(Range{begin, begin + n});
      };
      for (std::int64_t k = range.begin; k < range.end; ++k) {
        const std::int64_t node = view(walked_.queue)[k];
        if (!query(node, thread)) continue;
        adjacency_.for_each_neighbor(node, [&](std::int64_t j) {
          if (request_.is_masked_out(j) || !walked_.claim(j)) return;
          next.push_back(j);
          if (view(next).size() == nodes_per_range) hand_on();
        });
      }
      hand_on();
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  // Finds the balls that may hold a node within the limit. For each such ball, stores a lower bound on the distance from the
  // centre of the ball to the surface.
  void find_near_balls(const NodeBalls &balls) {
    std::vector<NearBall> &near = walked_.near_balls;
    near.clear();
    const auto within = [&](const Ball &ball) {
      return limit_ + ball.radius + slack(limit_ + ball.radius, ball.centre);
    };
    const auto may_be_near = [&](const Ball &ball) { return distances_.may_be_within(ball.centre, within(ball)); };
    std::vector<std::int64_t> &near_large = walked_.near_large_balls;
    near_large.clear();
    near_large.reserve(balls.large_balls.size());
    for (std::int64_t s = 0; s < view(balls.large_balls).size(); ++s)
      if (may_be_near(view(balls.large_balls)[s])) near_large.push_back(s);
    const auto n = view(near_large).size();
    const int n_threads = request_.n_threads.for_part(n, few_large_balls);
    const int n_ran = parallel_for_ranges(n, balls_per_block, n_threads, [&](const Range &block, int thread) {
      NeighborScratch::Thread &own = view(walked_.threads)[thread];
      const auto is_near = [&](const Ball &ball, double &distance) {
        ++own.n_queries;
        distance = distances_.lower_bound(ball.centre, within(ball));
        return distance <= within(ball);
      };
      for (std::int64_t k = block.begin; k < block.end; ++k) {
        const std::int64_t s = view(near_large)[k];
        double distance;
        if (!is_near(view(balls.large_balls)[s], distance)) continue;
        const Range range = balls.balls_of(s);
        for (std::int64_t ball = range.begin; ball < range.end; ++ball)
          if (may_be_near(view(balls.balls)[ball]) && is_near(view(balls.balls)[ball], distance))
            own.near_balls.push_back({ball, distance});
      }
    });
    n_threads_ = std::max(n_threads_, n_ran);
    for (const auto &own : walked_.threads) near.insert(near.end(), own.near_balls.begin(), own.near_balls.end());
    // Sorts the near balls, because their order must not depend on the threads.
    std::sort(near.begin(), near.end(), [](const auto &a, const auto &b) { return a.ball < b.ball; });
  }

  // Starts the walk at one node of every near ball: the first node that is not proved to be far from the surface.
  void begin_in_near_balls(const NodeBalls &balls) {
    for (const NearBall &near : walked_.near_balls) {
      const Range range = balls.nodes_of(near.ball);
      for (std::int64_t k = range.begin; k < range.end; ++k) {
        const std::int64_t node = view(balls.order)[k];
        if (request_.is_masked_out(node) || is_far(balls, near, node)) continue;
        begin_at(node);
        break;
      }
    }
  }

  // Queries those nodes of near balls that the walk did not reach. Leaves out nodes that are proved to be far by the distance of
  // the ball's centre.
  void prove(const NodeBalls &balls) {
    const auto n = view(walked_.near_balls).size();
    const int n_ran = parallel_for_ranges(n, balls_per_block, threads_near(), [&](const Range &block, int thread) {
      const UnfilledVector<FoundNode> &found = view(found_.by_thread)[thread];
      const std::int64_t n_before = view(found).size();
      for (std::int64_t g = block.begin; g < block.end; ++g) {
        const NearBall &near = view(walked_.near_balls)[g];
        const Range range = balls.nodes_of(near.ball);
        for (std::int64_t k = range.begin; k < range.end; ++k) {
          const std::int64_t node = view(balls.order)[k];
          if (request_.is_masked_out(node) || walked_.is_claimed(node) || is_far(balls, near, node)) continue;
          query(node, thread);
        }
      }
      n_unreached_.fetch_add(view(found).size() - n_before, std::memory_order_relaxed);
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  // Returns the number of threads for work on the nodes of the near balls.
  int threads_near() const { return request_.n_threads.for_part(view(walked_.near_balls).size(), few_balls); }

  SearchReport report(bool complete) {
    std::int64_t n_queries = 0;
    for (const auto &own : walked_.threads) n_queries += own.n_queries;
    return {n_queries, n_threads_, complete, n_unreached_};
  }

 private:
  // Queries the distance of a node. If the node is within the limit, adds it to the found nodes and returns true.
  bool query(std::int64_t node, int thread) {
    const Vec3 p = checked_point(nodes_, node, "node", RIIS_INVALID_MESH);
    if (!distances_.may_be_within(p, limit_)) return false;
    ++view(walked_.threads)[thread].n_queries;
    const ClosestTriangle closest = distances_.closest(p, limit_, found_.ties_of(thread));
    if (closest.triangle < 0) return false;
    found_.add(thread, node, closest);
    return true;
  }

  // Returns true if the node is certainly farther from the surface than the limit. The proof is a lower bound on the node's
  // distance: the distance of the ball's centre minus the distance from the centre to the node.
  bool is_far(const NodeBalls &balls, const NearBall &near, std::int64_t node) const {
    const Vec3 centre = view(balls.balls)[near.ball].centre;
    const double from_centre = distance(centre, nodes_[node]);
    return near.distance - from_centre > limit_ + slack(near.distance + from_centre, centre);
  }

  // Bounds the sum of the rounding errors of two distances and of a ball's radius. The bound is proportional to the two
  // distances, the radius, and the coordinates of the nodes and the triangles.
  double slack(double distances, Vec3 centre) const {
    return 1e-14 * (distances + std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z)) +
           2 * distances_.rounding();
  }

  const SearchRequest &request_;
  const StridedPoints &nodes_;
  const Adjacency &adjacency_;
  const Distances distances_;
  double limit_;
  FoundNodes &found_;
  NeighborScratch &walked_;
  std::atomic<std::int64_t> n_queued_{0}, n_unreached_{0};
  int n_threads_ = 1;
};

}  // namespace

void NeighborScratch::prepare(std::int64_t n_nodes, int n_threads) {
  const auto n = static_cast<std::size_t>(n_nodes);
  if (n_nodes != n_marks_ || walk_ == 255) {
    if (n_nodes != n_marks_) marks_ = std::make_unique<std::atomic<std::uint8_t>[]>(n);
    n_marks_ = n_nodes;
    for (std::size_t i = 0; i < n; ++i) marks_[i].store(0, std::memory_order_relaxed);
    walk_ = 0;
  }
  ++walk_;
  queue.resize(n);
  if (view(threads).size() < n_threads) resize(threads, n_threads);
  std::size_t largest = 0;
  for (const Thread &thread : threads) largest = std::max(largest, thread.near_balls.capacity());
  for (Thread &thread : threads) {
    thread.clear();
    thread.next.reserve(nodes_per_range);
    thread.near_balls.reserve(largest);
  }
}

SearchReport search_neighbors(const SearchRequest &request, const std::vector<std::int64_t> &last,
                              NeighborScratch &scratch, FoundNodes &found) {
  const NodeBalls &balls = request.mesh.balls(request.n_threads);
  return with_distances(request.surface, request.instructions, [&](const auto &distances) {
    NeighborSearch search(request, distances, scratch, found);
    search.find_near_balls(balls);
    for (const std::int64_t node : last) search.begin_at(node);
    if (last.empty()) search.begin_in_near_balls(balls);
    search.walk(search.threads_near());
    search.prove(balls);
    return search.report(true);
  });
}

SearchReport search_as_the_paper(const SearchRequest &request, NeighborScratch &scratch, FoundNodes &found) {
  const StridedPoints &nodes = request.mesh.points();
  const Vec3 start = request.surface.triangles().corners(0)[0];
  std::int64_t nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < nodes.n; ++i) {
    const double from_start = distance(nodes[i], start);
    if (!request.is_masked_out(i) && from_start < least) least = from_start, nearest = i;
  }
  return with_distances(request.surface, request.instructions, [&](const auto &distances) {
    NeighborSearch search(request, distances, scratch, found);
    if (nearest >= 0) search.begin_at(nearest);
    search.walk(request.n_threads);
    return search.report(false);
  });
}

}  // namespace riis
