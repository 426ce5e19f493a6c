// Workers that run the engine: one for the selected cell, the others (or the same one on a single processor) for lists of cells.

const BATCH = 512; // cells; a worker computes as many as fit into its time slice and returns the others

class Workers {
  constructor(bytes, source) {
    const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    const processors = Math.max(1, Math.min(navigator.hardwareConcurrency || 2, 16));
    this.orders = 0;
    this.waiting = new Map(); // maps a request's number to its waiting caller
    this.one = this.#start(url, bytes);
    this.many = Array.from({ length: processors }, () => this.#start(url, bytes));
    this.idle = [...this.many];
    this.jobs = [];
  }
  #start(url, bytes) {
    const worker = new Worker(url);
    worker.postMessage({ bytes });
    worker.onmessage = ({ data }) => this.waiting.get(data.number)?.(data);
    return worker;
  }
  // Solves one cell; a newer request cancels it. tell(data) is called repeatedly and at the end.
  lookAt(cell, tell, knocked = false) {
    this.waiting.delete(this.looking);
    this.looking = ++this.orders;
    this.waiting.set(this.looking, tell);
    this.one.postMessage({ number: this.looking, cell, knocked });
  }
  giveUp() {
    this.waiting.delete(this.looking);
    this.looking = ++this.orders;
    this.one.postMessage({ number: this.looking });
  }
  // A job: {cell, sides: both axes {sets, clears}, take(most) -> {places, cells} or null, give(places, results)}. The most recent
  // job is served first; end(job) removes it.
  begin(job) {
    this.jobs.unshift(job);
    this.#feed();
  }
  end(job) {
    job.ended = true;
    this.jobs = this.jobs.filter((other) => other !== job);
  }
  #feed() {
    while (this.idle.length > 0) {
      const job = this.jobs.find((one) => one.hasMore());
      if (!job) return;
      this.#serve(this.idle.pop(), job);
    }
  }
  #serve(worker, job) {
    const batch = job.take(BATCH);
    const number = ++this.orders;
    this.waiting.set(number, ({ done, results }) => {
      this.waiting.delete(number);
      this.idle.push(worker);
      if (!job.ended) {
        if (done < batch.places.length) job.putBack(batch.places.slice(done));
        job.give(batch.places.slice(0, done), results);
      }
      this.#feed();
    });
    worker.postMessage({ number, cell: job.cell, sides: job.sides, cells: batch.cells });
  }
  // One cell as in the file, where `sides` have these values, none or one each.
  solve(cell, sides, values) {
    return new Promise((done) => {
      let waits = true;
      const job = {
        cell, sides, hasMore: () => waits, putBack: () => (waits = true),
        take: () => {
          waits = false;
          return { places: [0], cells: Float64Array.from(values.length > 0 ? values : [NaN, NaN]) }; // two per cell
        },
        give: (_, [regime, impacts, period, peak_force_ratio]) => {
          this.end(job);
          done({ regime, impacts, period, peak_force_ratio });
        },
      };
      this.begin(job);
    });
  }
}
