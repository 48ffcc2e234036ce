// Which order to compute in, and what goes in circles.
#pragma once

#include <vector>

namespace voxsheet::sheet {

/// Nodes 0 … n-1; edges[i]: the nodes that i needs.
using DependencyGraph = std::vector<std::vector<int>>;

/// The strongly connected components, each after those that it needs (Tarjan, "Depth-first search and linear
/// graph algorithms", SIAM J. Comput. 1(2), 1972; here without recursion). A component of one node without an
/// edge to itself is no cycle; every other is.
[[nodiscard]] std::vector<std::vector<int>> componentsInOrder(const DependencyGraph& graph);

/// A shortest cycle through `node` within its component: node, …, node. Empty if it is in no cycle.
[[nodiscard]] std::vector<int> shortestCycle(const DependencyGraph& graph, int node);

} // namespace voxsheet::sheet
