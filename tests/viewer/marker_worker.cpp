// A reader at work on the markers of a case, without a window and without a pause, until it is killed:
// marker_worker STORE CASE NAME SEED. Says on its output what it is about to do ("want") and, once the history has
// reported it as saved, what it then sees ("have"); each is a list of [id, content], null for a deleted one.
#include <unistd.h>

#include <cstdio>
#include <map>
#include <random>

#include "vicon/viewer/model/marker_history.h"

using nlohmann::json;

namespace vicon::viewer {
namespace {

constexpr std::size_t kFew = 4, kMany = 12;  // markers: below the first none is deleted, above the second none added

using State = std::map<std::string, std::optional<Marker>>;

json contentOf(const std::optional<Marker>& marker)
{
    if (!marker)
        return nullptr;
    json content = toJson(*marker);
    for (const char* key : {"id", "created", "changed"})
        content.erase(key);
    return content;
}

void say(const char* what, const State& state)
{
    json list = json::array();
    for (const auto& [id, marker] : state)
        list.push_back({id, contentOf(marker)});
    const std::string line = what + (" " + list.dump()) + "\n";
    if (::write(STDOUT_FILENO, line.data(), line.size()) != ssize_t(line.size()))
        std::perror("marker_worker");
}

class Reader {
public:
    Reader(const char* store, std::string case_id, std::string name, unsigned seed)
        : store_(store), case_(std::move(case_id)), name_(std::move(name)), history_(case_), random_(seed)
    {
        look();
    }

    void doSomething()
    {
        const std::size_t dice = pick(10);
        if (mine_.empty() || (dice < 3 && mine_.size() < kMany))
            add();
        else if (dice < 5)
            change(any());
        else if (dice < 7)
            pairOrPart();
        else if (dice == 7 && mine_.size() > kFew)
            remove(any());
        else if (dice == 8 && !undo_.empty())
            goBack();
        else if (dice == 9 && !redo_.empty())
            goOn();
    }

private:
    std::size_t pick(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
    Marker any() { return std::next(mine_.begin(), std::ptrdiff_t(pick(mine_.size())))->second; }
    std::string note() { return name_ + " " + std::to_string(random_()); }

    void look()
    {
        mine_.clear();
        for (const Marker& marker : store_.markers(case_))
            if (marker.note.starts_with(name_ + " "))
                mine_[marker.id] = marker;
    }

    State seen(const State& like) const
    {
        State now;
        for (const auto& [id, ignored] : like)
            now[id] = mine_.contains(id) ? std::optional(mine_.at(id)) : std::nullopt;
        return now;
    }

    template <class Work>
    void report(const State& wanted, Work work)
    {
        say("want", wanted);
        work();
        look();
        say("have", seen(wanted));
    }

    template <class Work>
    void step(const State& wanted, Work work)
    {
        undo_.push_back({seen(wanted), wanted});
        redo_.clear();
        report(wanted, work);
    }

    void add()
    {
        Marker marker;
        marker.scan_id = pick(2) == 0 ? "s1" : "s2";
        marker.note = note();
        marker.position_mm = {double(pick(100)), double(pick(100)), double(pick(100))};
        say("want", {{"", marker}});
        const Marker added = history_.add(store_, marker);
        look();
        const State after = seen({{added.id, {}}});
        say("have", after);
        undo_.push_back({{{added.id, std::nullopt}}, after});
        redo_.clear();
    }

    void change(const Marker& before)
    {
        Marker after = before;
        after.note = note();
        step({{before.id, after}}, [&] { history_.change(store_, before, after); });
    }

    static Marker parted(Marker marker)
    {
        marker.partners.clear();
        return marker;
    }

    State withoutPairOf(const Marker& marker) const
    {
        State wanted{{marker.id, parted(marker)}};
        if (const auto other = mine_.find(partnerNames(marker)); other != mine_.end())  // of two scans: one at most
            wanted[other->first] = parted(other->second);
        return wanted;
    }

    void pairOrPart()
    {
        const Marker a = any(), b = any();
        if (!a.partners.empty()) {
            step(withoutPairOf(a), [&] { history_.part(store_, a); });
        } else if (a.scan_id != b.scan_id) {
            State wanted = withoutPairOf(b);
            wanted[a.id] = a;
            wanted[b.id] = b;
            wanted[a.id]->partners = {b.id};
            wanted[b.id]->partners = {a.id};
            step(wanted, [&] { history_.pair(store_, a, b); });
        }
    }

    void remove(const Marker& marker)
    {
        State wanted = withoutPairOf(marker);
        wanted[marker.id] = std::nullopt;
        step(wanted, [&] { history_.remove(store_, marker); });
    }

    void goBack()
    {
        redo_.push_back(undo_.back());
        undo_.pop_back();
        report(redo_.back().before, [&] { history_.undo(store_); });
    }

    void goOn()
    {
        undo_.push_back(redo_.back());
        redo_.pop_back();
        report(undo_.back().after, [&] { history_.redo(store_); });
    }

    struct Step {
        State before, after;
    };
    CaseStore store_;
    std::string case_, name_;
    MarkerHistory history_;
    std::mt19937 random_;
    std::map<std::string, Marker> mine_;
    std::vector<Step> undo_, redo_;
};

}  // namespace
}  // namespace vicon::viewer

int main(int argc, char** argv)
{
    if (argc != 5)
        return 2;
    try {
        vicon::viewer::Reader reader(argv[1], argv[2], argv[3], unsigned(std::stoul(argv[4])));
        while (::getppid() != 1)
            reader.doSomething();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "marker_worker: %s\n", e.what());
    }
    return 1;
}
