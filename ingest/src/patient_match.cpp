#include "vicon/ingest/patient_match.h"

#include <algorithm>
#include <vector>

#include "text.h"

namespace vicon::ingest {
namespace {

/// The groups of a person name, as they are compared: alphabetic, ideographic, phonetic.
std::vector<std::string> nameGroups(const std::string& name)
{
    std::vector<std::string> groups;
    for (std::size_t from = 0; from <= name.size();) {
        const std::size_t to = std::min(name.find('=', from), name.size());
        groups.push_back(foldedForComparison(name.substr(from, to - from)));
        from = to + 1;
    }
    return groups;
}

bool sameName(const std::string& a, const std::string& b)
{
    const auto x = nameGroups(a), y = nameGroups(b);
    for (std::size_t n = 0; n < std::min(x.size(), y.size()); ++n)
        if (!x[n].empty() && !y[n].empty() && x[n] != y[n])
            return false;
    return true;
}

}  // namespace

bool sameNameAndBirth(const Patient& a, const Patient& b)
{
    return sameName(a.name, b.name) && (a.birth_date.empty() || b.birth_date.empty() || a.birth_date == b.birth_date);
}

bool samePatient(const Patient& a, const Patient& b)
{
    return a.id == b.id && sameNameAndBirth(a, b);
}

bool contradict(const Patient& a, const Patient& b)
{
    return (!a.id.empty() && !b.id.empty() && a.id != b.id) || !sameNameAndBirth(a, b);
}

void addWhatIsNotKnown(Patient& known, const Patient& said)
{
    for (std::string Patient::*field : {&Patient::id, &Patient::name, &Patient::birth_date, &Patient::sex})
        if ((known.*field).empty())
            known.*field = said.*field;
}

}  // namespace vicon::ingest
