// The part of Sections that is about earlier reports.
#include "sections.h"
#include "vicon/report/comparison_statements.h"

namespace vicon::report {

void Sections::drawComparison()
{
    const std::vector<Statement> said = comparisonStatements(content_.read);
    if (said.empty())
        return;
    const StatementTable table(flow_.type, said, flow_.width());
    drawSection(flow_, "Compared with earlier reports", std::min(table.height(), flow_.wholePage() / 2));
    table.draw(flow_, flow_.left());
    flow_.skip(look::kGap);
}

}  // namespace vicon::report
