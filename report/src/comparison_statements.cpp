#include "vicon/report/comparison_statements.h"

#include "vicon/cases/printed.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {

std::string priorWords(const Comparison& c)
{
    std::string out = c.prior_what.empty() ? "finding" : c.prior_what;
    out += c.before.size_mm ? " of " + millimetres(*c.before.size_mm, 1) : ", size not given";
    if (!c.prior_place.empty())
        out += " in the " + c.prior_place;
    out += c.before.date.empty() ? ", not dated" : " on " + printedDate(c.before.date);
    return out + " (" + c.prior_name + (c.maker.empty() ? "" : ", " + c.maker) + ")";
}

std::vector<Statement> comparisonStatements(const ReadCase& read)
{
    std::vector<Statement> out;
    for (const ComparedFinding& compared : read.comparisons) {
        if (!compared.said.confirmed)
            continue;
        const std::string now = compared.now.size_mm ? millimetres(*compared.now.size_mm, 1) : "not measured";
        out.push_back({"Finding " + std::to_string(Finding{.id = compared.said.finding_id}.number()),
                       "then " + priorWords(compared.said) + "; now " + now + "; " + growthWords(compared.growth)});
    }
    return out;
}

}  // namespace vicon::report
