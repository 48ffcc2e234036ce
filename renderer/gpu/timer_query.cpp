#include "gpu/timer_query.h"

#include "gpu/context.h"

namespace voxsheet::gpu {

namespace {

constexpr double kMsPerNs = 1e-6;

ObjectName createTimestamp(Context& context) {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    ++context.mutableCounts().queries;
    return {context, id};
}

void destroyQuery(const ObjectName& name) {
    if (!name) return;
    const GLuint id = name.id();
    glDeleteQueries(1, &id);
    --name.context().mutableCounts().queries;
}

GLuint64 timestampNs(const ObjectName& name) {
    GLuint64 ns = 0;
    glGetQueryObjectui64v(name.id(), GL_QUERY_RESULT, &ns);
    return ns;
}

} // namespace

TimerQuery::TimerQuery(Context& context) : begin_(createTimestamp(context)), end_(createTimestamp(context)) {
    context.checkErrors("making a timer");
}

TimerQuery& TimerQuery::operator=(TimerQuery&& other) noexcept {
    std::swap(begin_, other.begin_);
    std::swap(end_, other.end_);
    return *this;
}

TimerQuery::~TimerQuery() {
    destroyQuery(begin_);
    destroyQuery(end_);
}

void TimerQuery::begin() { glQueryCounter(begin_.id(), GL_TIMESTAMP); }
void TimerQuery::end() { glQueryCounter(end_.id(), GL_TIMESTAMP); }

std::optional<double> TimerQuery::tryMilliseconds() const {
    GLint available = GL_FALSE;
    glGetQueryObjectiv(end_.id(), GL_QUERY_RESULT_AVAILABLE, &available);
    if (available != GL_TRUE) return std::nullopt;
    return milliseconds();
}

double TimerQuery::milliseconds() const {
    const GLuint64 beginNs = timestampNs(begin_);
    const GLuint64 endNs = timestampNs(end_);
    return endNs > beginNs ? static_cast<double>(endNs - beginNs) * kMsPerNs : 0.0;
}

} // namespace voxsheet::gpu
