// A small cache of things derived from immutable inputs: the least recently used goes first.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

namespace voxsheet {

template <typename Key, typename Value>
class RecentCache {
public:
    explicit RecentCache(std::size_t capacity) : capacity_(capacity) {}

    /// The value of the first key for which matches(key) holds, now the most recently used; nullptr if there
    /// is none.
    template <typename Matches>
    Value* find(Matches matches) {
        for (auto it = entries_.begin(); it != entries_.end(); ++it)
            if (matches(it->first)) {
                entries_.splice(entries_.begin(), entries_, it);
                return &it->second;
            }
        return nullptr;
    }

    /// The reference holds until the next insert().
    Value& insert(Key key, Value value) {
        if (entries_.size() == capacity_) entries_.pop_back();
        entries_.emplace_front(std::move(key), std::move(value));
        return entries_.front().second;
    }

private:
    std::size_t capacity_;
    std::list<std::pair<Key, Value>> entries_;
};

} // namespace voxsheet
