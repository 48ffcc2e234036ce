#include "sheet/formula/dependency_graph.h"

#include <algorithm>
#include <cstddef>
#include <deque>

namespace voxsheet::sheet {

namespace {

class Tarjan {
public:
    explicit Tarjan(const DependencyGraph& graph)
        : graph_(graph), number_(graph.size(), -1), low_(graph.size(), 0), onStack_(graph.size(), false) {}

    std::vector<std::vector<int>> run() {
        for (std::size_t i = 0; i < graph_.size(); ++i)
            if (number_[i] < 0) visit(i);
        return std::move(components_);
    }

private:
    struct Frame {
        std::size_t node;
        std::size_t nextEdge = 0;
    };

    void open(std::size_t node) {
        number_[node] = low_[node] = count_++;
        stack_.push_back(node);
        onStack_[node] = true;
        frames_.push_back({node});
    }

    void visit(std::size_t start) {
        open(start);
        while (!frames_.empty()) {
            Frame& frame = frames_.back();
            const std::size_t node = frame.node;
            if (frame.nextEdge < graph_[node].size()) {
                const auto next = static_cast<std::size_t>(graph_[node][frame.nextEdge++]);
                if (number_[next] < 0)
                    open(next);
                else if (onStack_[next])
                    low_[node] = std::min(low_[node], number_[next]);
                continue;
            }
            frames_.pop_back();
            if (!frames_.empty()) low_[frames_.back().node] = std::min(low_[frames_.back().node], low_[node]);
            if (low_[node] == number_[node]) close(node);
        }
    }

    void close(std::size_t root) {
        std::vector<int> component;
        std::size_t node = root;
        do {
            node = stack_.back();
            stack_.pop_back();
            onStack_[node] = false;
            component.push_back(static_cast<int>(node));
        } while (node != root);
        std::sort(component.begin(), component.end());
        components_.push_back(std::move(component));
    }

    const DependencyGraph& graph_;
    std::vector<int> number_;
    std::vector<int> low_;
    std::vector<bool> onStack_;
    std::vector<std::size_t> stack_;
    std::vector<Frame> frames_;
    int count_ = 0;
    std::vector<std::vector<int>> components_;
};

} // namespace

std::vector<std::vector<int>> componentsInOrder(const DependencyGraph& graph) { return Tarjan(graph).run(); }

std::vector<int> shortestCycle(const DependencyGraph& graph, int node) {
    std::vector<int> from(graph.size(), -1);
    std::deque<int> waiting{node};
    while (!waiting.empty()) {
        const int current = waiting.front();
        waiting.pop_front();
        for (const int next : graph[static_cast<std::size_t>(current)]) {
            if (next == node) {
                std::vector<int> cycle{node};
                for (int at = current; at != node; at = from[static_cast<std::size_t>(at)])
                    cycle.push_back(at);
                cycle.push_back(node);
                std::reverse(cycle.begin(), cycle.end());
                return cycle;
            }
            if (from[static_cast<std::size_t>(next)] >= 0) continue;
            from[static_cast<std::size_t>(next)] = current;
            waiting.push_back(next);
        }
    }
    return {};
}

} // namespace voxsheet::sheet
