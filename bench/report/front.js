// The Pareto front: as front.hpp says.

const sameError = 1.01;
const dominates = (one, other) => one.cost <= other.cost && one.error <= other.error * sameError &&
  (one.cost < other.cost || one.error * sameError < other.error);
export const onFront = points => points.map(point => !points.some(other => dominates(other, point)));
