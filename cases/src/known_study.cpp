#include "vicon/cases/known_study.h"

namespace vicon {

void fillIn(Assessment& said, const KnownStudy& known)
{
    if (said.indication.empty())
        said.indication = known.indication;
    if (said.technique.empty())
        said.technique = known.technique;
    const auto fill = [](std::optional<double>& field, const std::optional<double>& value) {
        if (!field)
            field = value;
    };
    fill(said.dose_mgy_cm, known.dose_mgy_cm);
    fill(said.reading_minutes, known.reading_minutes);
    fill(said.coverage_percent, known.coverage_percent);
}

}  // namespace vicon
