#include "dem/statics/elimination_tree.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

#include "dem/statics/nested_dissection.h"

namespace ddem {
namespace {

/// Of the work of all, at most so much is in one of the subtrees: more of them would keep more of what they leave over until all are done.
constexpr double kLargestSubtree = 1.0 / 6.0;

using Lists = std::vector<std::vector<int>>;

/// Up to so many discs a front is joined with its parent whatever zeros that adds, and beyond up to so large a share of them.
constexpr int kSmallFront = 4;
constexpr double kZeros = 0.2;

/// Whom each disc is bonded to, itself left out.
Lists neighbours(int discs, const Bonds& b) {
  Lists lists(static_cast<std::size_t>(discs));
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (b.i[c] == b.j[c]) continue;
    lists[b.i[c]].push_back(b.j[c]);
    lists[b.j[c]].push_back(b.i[c]);
  }
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lists;
}

std::vector<int> minimum_degree(const Lists& lists) {
  const auto discs = static_cast<Eigen::Index>(lists.size());
  Eigen::SparseMatrix<double> graph(discs, discs);
  std::vector<int> entries;
  for (const auto& list : lists) entries.push_back(static_cast<int>(list.size()) + 1);
  graph.reserve(entries);
  for (int p = 0; p < static_cast<int>(discs); ++p) {
    graph.insert(p, p) = 1.0;  // without them the order is no order
    for (const int q : lists[p]) graph.insert(q, p) = 1.0;
  }
  graph.makeCompressed();
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);
  return {order.indices().begin(), order.indices().end()};
}

/// The tree in an order of elimination: the next disc that each is coupled with once those before it are gone, or -1.
std::vector<int> parents(const Lists& lists, const std::vector<int>& order, const std::vector<int>& place) {
  std::vector<int> parent(order.size(), -1), ancestor(order.size(), -1);
  for (int k = 0; k < static_cast<int>(order.size()); ++k) {
    for (const int neighbour : lists[order[k]]) {
      for (int p = place[neighbour]; p < k;) {
        const int next = ancestor[p];
        ancestor[p] = k;
        if (next < 0) parent[p] = k;
        if (next < 0 || next == k) break;
        p = next;
      }
    }
  }
  return parent;
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) place[order[k]] = k;
  return place;
}

/// Children right before their parent: the same elimination, but what is joined stands together.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  Lists children(parent.size());
  std::vector<int> stack, order;
  for (int k = n; k-- > 0;) {
    if (parent[k] >= 0) {
      children[parent[k]].push_back(k);
    } else {
      stack.push_back(k);
    }
  }
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {  // a parent before its children, reversed
    const int k = stack.back();
    stack.pop_back();
    order.push_back(k);
    for (const int child : children[k]) stack.push_back(child);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Entries of the columns of a front, in blocks of a disc by a disc.
double entries(int own, std::size_t rest) { return 0.5 * own * (own + 1) + static_cast<double>(own) * static_cast<double>(rest); }

/// Fronts of single discs joined with those that follow them.
std::vector<Front> joined_fronts(const std::vector<int>& parent, Lists& coupled) {
  std::vector<Front> fronts;
  std::vector<double> filled;  // entries of the fronts that are not zero
  for (int k = 0; k < static_cast<int>(parent.size()); ++k) {
    Front front{k, k + 1, std::move(coupled[k]), {}};
    double fill = entries(1, front.rest.size());
    while (!fronts.empty()) {
      const Front& last = fronts.back();
      if (parent[last.end - 1] < front.begin || parent[last.end - 1] >= front.end) break;
      const int own = last.own() + front.own();
      const double all = entries(own, front.rest.size()), both = fill + filled.back();
      if (own > kSmallFront && all - both > kZeros * all) break;
      front.begin = last.begin;
      fill = both;
      fronts.pop_back();
      filled.pop_back();
    }
    fronts.push_back(std::move(front));
    filled.push_back(fill);
  }
  return fronts;
}

}  // namespace

EliminationTree elimination_tree(const Packing& packing, const Bonds& bonds) {
  const int discs = static_cast<int>(packing.size());
  const Lists lists = neighbours(discs, bonds);
  std::vector<int> order = discs > kManyDiscs ? nested_dissection(packing, lists) : minimum_degree(lists);
  const std::vector<int> post = postorder(parents(lists, order, inverse(order)));
  std::vector<int> ordered;
  for (const int k : post) ordered.push_back(order[k]);
  order = std::move(ordered);

  EliminationTree tree;
  tree.place = inverse(order);
  const std::vector<int> parent = parents(lists, order, tree.place);
  Lists coupled(order.size());
  for (int k = 0; k < discs; ++k) {
    for (const int neighbour : lists[order[k]]) {
      if (tree.place[neighbour] > k) coupled[k].push_back(tree.place[neighbour]);
    }
  }
  for (int k = 0; k < discs; ++k) {  // all of a place's children come before it
    std::sort(coupled[k].begin(), coupled[k].end());
    coupled[k].erase(std::unique(coupled[k].begin(), coupled[k].end()), coupled[k].end());
    if (parent[k] < 0) continue;
    auto& above = coupled[parent[k]];
    above.insert(above.end(), coupled[k].begin() + 1, coupled[k].end());
  }
  tree.fronts = joined_fronts(parent, coupled);
  tree.front_of.resize(order.size());
  for (int f = 0; f < static_cast<int>(tree.fronts.size()); ++f) {
    const Front& front = tree.fronts[f];
    std::fill(tree.front_of.begin() + front.begin, tree.front_of.begin() + front.end, f);
  }
  for (int f = 0; f < static_cast<int>(tree.fronts.size()); ++f) {
    if (!tree.fronts[f].rest.empty()) tree.fronts[tree.front_of[tree.fronts[f].rest.front()]].children.push_back(f);
  }
  return tree;
}

Subtrees subtrees_of(const EliminationTree& tree) {
  const int fronts = static_cast<int>(tree.fronts.size());
  if (fronts == 0) return {};
  if (static_cast<int>(tree.place.size()) <= kManyDiscs) return {{{0, fronts}}, {}};
  std::vector<int> begin(tree.fronts.size());
  std::vector<double> work(tree.fronts.size());  // of a front with all below it
  for (int f = 0; f < fronts; ++f) {
    const Front& front = tree.fronts[f];
    const double own = front.own(), all = own + static_cast<double>(front.rest.size());
    begin[f] = f;
    work[f] = own * all * all;
    for (const int child : front.children) {
      begin[f] = std::min(begin[f], begin[child]);
      work[f] += work[child];
    }
  }
  double largest = 0.0;
  std::vector<int> open;
  for (int f = 0; f < fronts; ++f) {
    if (tree.fronts[f].rest.empty()) open.push_back(f), largest += kLargestSubtree * work[f];
  }
  Subtrees result;
  while (!open.empty()) {
    const int f = open.back();
    open.pop_back();
    if (work[f] <= largest || tree.fronts[f].children.empty()) {
      result.ranges.push_back({begin[f], f + 1});
    } else {
      result.top.push_back(f);
      open.insert(open.end(), tree.fronts[f].children.begin(), tree.fronts[f].children.end());
    }
  }
  std::ranges::sort(result.ranges, {}, &Subtrees::Range::begin);
  std::ranges::sort(result.top);
  return result;
}

}  // namespace ddem
