#include "film/film_maker.h"

#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>

namespace vicon::viewer {

FilmMaker::FilmMaker(DrawingThread& drawing, QWidget* parent) : QWidget(parent), drawing_(drawing)
{
    bar_ = new QProgressBar(this);
    bar_->setObjectName("filmBar");
    bar_->setAccessibleName(tr("Progress of the film"));
    bar_->setFormat(tr("film %p %"));
    cancel_ = new QPushButton(tr("Cancel"), this);
    cancel_->setObjectName("filmCancel");
    cancel_->setToolTip(tr("Stop filming and keep nothing"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(bar_);
    row->addWidget(cancel_);
    hide();
    connect(cancel_, &QPushButton::clicked, this, &FilmMaker::cancel);
    connect(&drawing_, &DrawingThread::filmed, this, [this](const std::shared_ptr<Film>& film, bool finished) {
        if (film != film_)
            return;  // of one that was cancelled
        if (finished) {
            end();
            emit this->finished(file_);
        } else {
            next();
        }
    });
    connect(&drawing_, &DrawingThread::filmFailed, this,
            [this](const std::shared_ptr<Film>& film, const QString& message) {
                if (film != film_)
                    return;
                end();
                emit failed(message);
            });
}

void FilmMaker::start(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, double from_mm, Heading heading,
                      double step_mm, const std::filesystem::path& file)
{
    scan_ = std::move(scan);
    request_ = request;
    request_.still = request_.count_seen = false;
    heading_ = heading;
    station_mm_ = from_mm_ = from_mm;
    step_mm_ = step_mm;
    file_ = QString::fromStdString(file.string());
    film_ = std::make_shared<Film>(file, kPictures_per_s);
    show();
    next();
}

void FilmMaker::next()
{
    const double length = scan_->files.frames().length_mm();
    const double end_mm = heading_ == Heading::caecum ? length : 0;
    const double way = std::abs(end_mm - from_mm_), done = std::abs(station_mm_ - from_mm_);
    bar_->setValue(way > 0 ? int(100 * done / way) : 100);
    const bool last = done >= way;
    request_.place.station_mm = station_mm_;
    drawing_.film(scan_, request_, heading_, film_, last);
    station_mm_ += (heading_ == Heading::caecum ? 1 : -1) * std::min(step_mm_, std::max(way - done, 0.0));
}

void FilmMaker::cancel()
{
    if (!film_)
        return;
    end();
    emit cancelled();
}

void FilmMaker::end()
{
    film_.reset();
    drawing_.giveUpFilm();
    scan_.reset();
    hide();
}

}  // namespace vicon::viewer
