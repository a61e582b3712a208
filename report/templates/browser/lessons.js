// Six lessons after the slides: how each is set up, and when its task is done.

// `typed` is the answer that was judged last, and `tried` are the values of dt that were set before anything blew up, until a limit is known to judge them by: it comes later.
const startOfLesson = () => ({tried: [], saidLimit: false, hungAt: null, typed: ""});
const lessonState = startOfLesson();

const LESSONS = [
  {slides: "2, 5", state: "s=oscillator&w=kick_drift&dt=0.0005&speed=0.05", answer: value => Math.abs(value / (2 * Math.PI * Math.sqrt(0.02 / 200)) - 1) < 0.02},
  {
    slides: "7-11", state: "s=string&w=heun,heun_link_by_link&dt=0.002&beside=0",
    check: () => {
      const [one, two] = lab.lanes.map(lane => schemes[lane.scheme]);
      return Boolean(one && two && one.kind !== "in_place" && two.kind === "in_place")
        && lab.series.some(row => row.time < 0.6 && row.apart[1] > 1e-3 && Number.isFinite(row.apart[1]));
    },
  },
  {
    slides: "15", state: "s=string&w=kick_drift&dt=0.004",
    check: () => {
      const {limit} = lab.limits.kick_drift || {}, lane = lab.lanes.find(one => one.scheme === "kick_drift");
      if (lane && !lane.world.blownUp) lessonState.tried.push(lab.dt);
      if (!lane || !limit) return false;
      if (lessonState.tried.some(dt => Math.abs(dt / limit - 1) < 0.01)) lessonState.saidLimit = true;
      lessonState.tried = [];
      return lessonState.saidLimit && Boolean(lane.world.blownUp) && lab.dt > limit;
    },
  },
  {slides: "2, 5", state: "s=oscillator&w=kick_drift,kick_drift_implicit_damping&dt=0.001&at=0:damping:1&speed=0.2", check: () => {
    const {limit} = lab.limits.kick_drift || {}, {F, at} = furthest().world.memory;
    return limit > 0 && limit <= 0.01 && F[at.damping] > 0 && lab.scene.name === "oscillator" && F[at.stiffness] === 200 && F[at.masses + 1] === 0.02;
  }},
  {slides: "18-22", state: "s=cloth&w=kick_drift&dt=0.001", check: () => {
    const {I, at} = furthest().world.memory, fixed = I.subarray(at.fixed, at.fixed + at.n).reduce((sum, one) => sum + one, 0);
    if (fixed !== 1 || lab.scene.name !== "cloth") { lessonState.hungAt = null; return false; }
    if (lessonState.hungAt === null || lessonState.hungAt > laneTime()) lessonState.hungAt = laneTime();
    return laneTime() >= lessonState.hungAt + 0.3 && !furthest().world.blownUp;
  }},
  {slides: "13, 15", state: "s=cloth&w=kick_drift,rk4&dt=0.002", answer: value => Math.abs(value / 0.5 - 1) < 0.02 && lab.scene.name === "cloth" && furthest().world.memory.F[furthest().world.memory.at.stiffness] >= 160},
];

// Whether the task of the lesson that is open is done, as things are now.
function lessonDone(typed) {
  const lesson = LESSONS[lab.lesson - 1];
  if (!lesson) return false;
  return lesson.answer ? lesson.answer(Number(String(typed).replace(",", "."))) : lesson.check();
}

// Whether the page has the scene of a lesson: one made for some scenes only may not.
const isHere = k => k === 0 || Boolean(LESSONS[k - 1] && sceneNamed(/s=(\w+)/.exec(LESSONS[k - 1].state)[1]));
