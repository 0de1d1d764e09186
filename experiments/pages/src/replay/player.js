// The clock: where the replay is after some real time has passed.

export const speeds = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 4, 8];

// At speed 1 a second shows ten frames, or fewer if the whole run would be over in less than 20 seconds.
export const framesPerSecond = (lastStep) => Math.min(10, lastStep / 20);

export class Player {
  constructor(lastStep) {
    this.lastStep = lastStep;
    this.rate = framesPerSecond(lastStep);
    this.speed = 1;
    this.playing = false;
    this.loop = null;  // [from, to]
  }

  get bounds() {
    return this.loop ?? [0, this.lastStep];
  }

  // Sets one end of the loop to a time. A loop that would be empty goes from or to the run's end.
  setLoop(end, time) {
    const loop = [...this.bounds];
    loop[end] = time;
    if (loop[1] <= loop[0]) loop[1 - end] = end === 0 ? this.lastStep : 0;
    this.loop = loop[1] > loop[0] ? loop : null;
  }

  // Returns the time `seconds` later. Without a loop the clock stops at the end.
  advance(time, seconds) {
    const [from, to] = this.bounds;
    const later = time + seconds * this.speed * this.rate;
    if (this.loop) return later > to || later < from ? from : later;
    if (later < to) return later;
    this.playing = false;
    return to;
  }

  // The time at which playing starts: at the end of the run it starts over.
  startTime(time) {
    const [from, to] = this.bounds;
    return time >= to || time < from ? from : time;
  }
}
