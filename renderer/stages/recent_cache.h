// A small cache of things derived from immutable inputs: the least recently used go first.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

namespace voxsheet {

template <typename Key, typename Value>
class RecentCache {
public:
    /// \param capacity  number of entries; or, where insert() is told costs, their sum
    explicit RecentCache(std::size_t capacity) : capacity_(capacity) {}

    /// The value of the first key for which matches(key) holds, now the most recently used; nullptr if there
    /// is none.
    template <typename Matches>
    Value* find(Matches matches) {
        for (auto it = entries_.begin(); it != entries_.end(); ++it)
            if (matches(it->key)) {
                entries_.splice(entries_.begin(), entries_, it);
                return &it->value;
            }
        return nullptr;
    }

    /// What is above it goes with the next insert().
    void setCapacity(std::size_t capacity) { capacity_ = capacity; }

    /// The newest entry stays even if it costs more than the capacity. The reference holds until the next
    /// insert().
    Value& insert(Key key, Value value, std::size_t cost = 1) {
        while (!entries_.empty() && cost_ + cost > capacity_) {
            cost_ -= entries_.back().cost;
            entries_.pop_back();
        }
        entries_.push_front({std::move(key), std::move(value), cost});
        cost_ += cost;
        return entries_.front().value;
    }

private:
    struct Entry {
        Key key;
        Value value;
        std::size_t cost;
    };
    std::size_t capacity_;
    std::size_t cost_ = 0;
    std::list<Entry> entries_;
};

} // namespace voxsheet
