#include "film/film_tool.h"

#include <utility>

#include "film/film_maker.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

FilmTool::FilmTool(Reading& reading) : ReadingTool(reading), maker_(new FilmMaker(reading.drawing())) {}

void FilmTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::a_case, tr("Film the way to the end (again: cancel)"), QKeySequence("Ctrl+M"),
                     [this] { startOrCancel(); });
    layout.addStatus(maker_);
    maker_->hide();
    connect(maker_, &FilmMaker::finished, this,
            [this](const QString& file) { reading_.say(tr("Film saved: %1").arg(file)); });
    connect(maker_, &FilmMaker::cancelled, this,
            [this] { reading_.say(tr("The film was cancelled; nothing is kept of it.")); });
    connect(maker_, &FilmMaker::failed, this, [this](const QString& message) {
        reading_.warn(tr("The film was not made, and nothing is kept of it: %1").arg(message));
    });
    connect(&reading_.session(), &CaseSession::filmNamed, this, &FilmTool::start);
}

void FilmTool::startOrCancel()
{
    if (!reading_.navigator())
        return;
    if (maker_->running()) {
        maker_->cancel();
        return;
    }
    if (std::exchange(asked_, {})) {
        emit maker_->cancelled();
        return;
    }
    if (!reading_.navigator()->hasPath()) {
        reading_.say(tr("The %1 has no centreline: there is no way to film.")
                         .arg(QString::fromStdString(reading_.organWords().organ.name())));
        return;
    }
    reading_.say(tr("Filming the way from here to the end; you can read on meanwhile"));
    asked_ = asFrom(reading_.navigator()->state());
    reading_.session().nameFilm();
}

FilmTool::Asked FilmTool::asFrom(const NavigationState& from) const
{
    constexpr int kLargest_px = 768;
    const QSize view = reading_.views().endoscopic()->pictureSize().boundedTo({kLargest_px, kLargest_px});
    const QSize size(view.width() / 2 * 2, view.height() / 2 * 2);  // Theora's colours have half the pixels
    const double step_mm = reading_.navigator()->speed_mm_s() / FilmMaker::kPictures_per_s;
    EndoscopicRequest request = reading_.requestFor(*reading_.scan(), from, size, false);
    request.snapshot.caption = reading_.scan()->saved_caption;
    request.snapshot.priors.clear();  // they are of one place
    return {reading_.sharedScan(), request, from.station_mm, reading_.navigator()->heading(), step_mm};
}

void FilmTool::start(const QString& file)
{
    const auto asked = std::exchange(asked_, {});
    if (asked && !file.isEmpty())
        maker_->start(asked->scan, asked->request, asked->from_mm, asked->heading, asked->step_mm, file.toStdString());
}

}  // namespace vicon::viewer
