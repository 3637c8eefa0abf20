#pragma once

namespace trailcast::bench {

// This script comes before a page's own. It is window.bench.
inline constexpr const char* kBenchScript = R"js(
window.bench = (() => {
  const shows = {
    fleet: (n) => document.querySelectorAll('.robot-row').length >= n,
    routes: () => document.querySelectorAll('.routes tbody tr').length > 0,
    history: () => document.querySelectorAll('.history tbody tr').length > 0,
  };
  let frames = [];
  let tasks = [];
  let counts = false;
  let shown = 0;
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) if (counts) tasks.push(entry.duration);
  }).observe({ entryTypes: ['longtask'] });
  // This counts frames, as a person sees it.
  const waitFor = (is) => {
    const from = performance.now();
    shown = 0;
    const look = () => {
      if (is()) shown = Math.max(0.1, performance.now() - from);
      else requestAnimationFrame(look);
    };
    look();
  };
  return {
    // This is the time from opening the page until it shows.
    watch: (name, n) => waitFor(() => shows[name](n)),
    go: (name, n) => { window.location.hash = name; waitFor(() => shows[name](n)); },
    // This types one letter at a time into the field, until the first row begins so.
    type: (selector, text) => {
      const field = document.querySelector(selector);
      const set = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set;
      let typed = 0;
      const next = () => {
        set.call(field, text.slice(0, ++typed));
        field.dispatchEvent(new Event('input', { bubbles: true }));
        if (typed < text.length) return setTimeout(next, 120);
        waitFor(() => document.querySelector('.routes tbody tr')?.textContent.startsWith(text));
      };
      shown = 0;
      next();
    },
    // This asks for the next page of the list, so often.
    more: (times) => {
      const rows = () => document.querySelector('.routes > [role=status]').textContent;
      const button = () => [...document.querySelectorAll('.routes > button')].at(-1);
      const next = () => {
        if (times-- === 0) return waitFor(() => true);
        const had = rows();
        button().click();
        const look = () => (rows() !== had && button() ? next() : requestAnimationFrame(look));
        look();
      };
      shown = 0;
      next();
    },
    shown: () => shown,
    start: (scrolls) => {
      frames = [];
      tasks = [];
      counts = true;
      let last = performance.now();
      let step = 25;
      const frame = (now) => {
        frames.push(now - last);
        last = now;
        if (scrolls) {
          const rows = document.querySelector('.pane.robots');
          const pane = rows && rows.scrollHeight > rows.clientHeight ? rows : document.scrollingElement;
          const before = pane.scrollTop;
          pane.scrollBy({ top: step, behavior: 'instant' });
          if (pane.scrollTop === before) step = -step;
        }
        if (counts) requestAnimationFrame(frame);
      };
      requestAnimationFrame(frame);
    },
    stop: () => {
      counts = false;
      const sorted = frames.slice(1).sort((a, b) => a - b);
      const at = (share) => sorted[Math.floor(share * (sorted.length - 1))] ?? 0;
      return {
        frames: sorted.length, median: at(0.5), p99: at(0.99), longest: at(1),
        late: sorted.filter((each) => each > 50).length,
        tasks: tasks.length, longest_task: Math.max(0, ...tasks),
        elements: document.getElementsByTagName('*').length,
      };
    },
  };
})();
)js";

// This script comes before that one to repeat a day. The page hears no console, but repeatedly what
// one has said within a minute, with each robot on another route every time. Each change is drawn
// before the next one comes. It needs window.said = {state, changes, routes}.
inline constexpr const char* kReplayScript = R"js(
window.replay = (() => {
  const listeners = {};
  let drawn = 0;
  window.EventSource = class {
    addEventListener(name, listener) { listeners[name] = listener; }
    close() {}
  };
  const tell = (name, what) => listeners[name]({ data: JSON.stringify(what) });
  let told = 0;
  let over = false;
  const elsewhere = (robots, time) => {
    for (const robot of robots) {
      const { routes } = window.said;
      const at = Number(robot.name.slice(-3));
      robot.route_id = routes[(at + time * 100) % routes.length];
      robot.route = 'aisle-' + (at + time * 100) % routes.length;
      robot.teaching = ((at + time * 100) % routes.length + 1).toString(16);
    }
  };
  const channel = new MessageChannel();
  const run = async (many) => {
    over = false;
    const until = told + many;
    const { changes } = window.said;
    while (told < until) {
      const what = JSON.parse(changes[told % changes.length]);
      elsewhere(what.robots, Math.floor(told / changes.length));
      what.now_unix_ms = Date.now();
      tell('change', what);
      ++told;
      await new Promise((resolve) => { channel.port1.onmessage = resolve; channel.port2.postMessage(0); });
    }
    over = true;
  };
  new MutationObserver(() => ++drawn).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
  return {
    begin: () => tell('state', JSON.parse(window.said.state)),
    run,
    at: () => ({ told, over, drawn }),
  };
})();
)js";

}  // namespace trailcast::bench
