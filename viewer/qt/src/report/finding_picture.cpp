// What the chosen finding looks like.
#include <QLabel>

#include "report/findings_part.h"

namespace vicon::viewer {

std::vector<Marker> FindingsPart::markersOf(const FindingWithFacts& one) const
{
    std::vector<std::string> ids;
    if (const FindingSight* lead = one.facts.lead())
        ids.push_back(lead->marker_id);
    for (const FindingSight& sight : one.facts.sights)
        ids.push_back(sight.marker_id);
    std::vector<Marker> markers;
    for (const std::string& id : ids)
        for (const Marker& marker : read_.markers)
            if (marker.id == id)
                markers.push_back(marker);
    return markers;
}

/// Another one where a marker is elsewhere, or looks otherwise.
std::string FindingsPart::pictureOf(const FindingWithFacts& one) const
{
    nlohmann::json seen = nlohmann::json::array({one.finding.id});
    for (const Marker& marker : markersOf(one)) {
        nlohmann::json of = toJson(marker);
        for (const char* unseen : {"station_mm", "from_caecum_mm", "fraction", "part", "changed", "note"})
            of.erase(unseen);
        seen.push_back(of);
    }
    return seen.dump();
}

void FindingsPart::askForPicture()
{
    const FindingWithFacts* one = chosen();
    if (!one)
        return;
    pictured_ = pictureOf(*one);
    picture_->clear();
    picture_->hide();
    emit pictureWanted(QString::fromStdString(pictured_), markersOf(*one));
}

void FindingsPart::showPicture(const QString& which, const QImage& picture)
{
    if (which.toStdString() != pictured_)
        return;
    picture_->setPixmap(QPixmap::fromImage(picture.scaledToWidth(kPicture_px, Qt::SmoothTransformation)));
    picture_->show();
}

}  // namespace vicon::viewer
