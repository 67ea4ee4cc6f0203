/* Compare any two to six submissions, with the numbers of `leaderboard compare`: from the same resamples of
   pairs, drawn again here, and by the same test. What is compared is in the address. */
"use strict";

(() => {
  const MOST = 6;
  const LETTERS = "ABCDEF";
  const N_TRIALS_SHOWN = 10;
  const TAILS = [0.025, 0.975];
  const MINUS = "\u2212";
  const NOTHING = "\u2013";
  const MULTIPLIER = [0xf645, 0x9fcc, 0xdf64, 0x4385, 0x5da4, 0x1fc6, 0xed05, 0x2360];

  const sum = (values) => values.reduce((total, value) => total + value, 0);
  const range = (n) => [...Array(n).keys()];
  const unique = (values) => [...new Set(values)];

  /* Drawing pairs as the grader does: raw numbers of PCG64 (O'Neill 2014), its 128 bits in limbs of 16. */

  function makeDrawer(state, increment) {
    const [limbs, words] = [new Float64Array(state), new Uint32Array(2)];
    let hasHigh = false;
    const step = () => {
      for (let i = 7; i >= 0; i -= 1) {
        limbs[i] *= MULTIPLIER[0];
        for (let j = 0; j < i; j += 1) limbs[i] += limbs[j] * MULTIPLIER[i - j];
      }
      for (let i = 0, carry = 0; i < 8; i += 1) {
        const total = limbs[i] + increment[i] + carry;
        limbs[i] = total % 65536;
        carry = Math.floor(total / 65536);
      }
      const word = (i) => limbs[2 * i] | (limbs[2 * i + 1] << 16);
      const halves = [word(0) ^ word(2), word(1) ^ word(3)];
      const turn = word(3) >>> 26;
      if (turn & 32) halves.reverse();
      const [low, high] = halves;
      const n = turn & 31;
      words[0] = n ? (low >>> n) | (high << (32 - n)) : low;
      words[1] = n ? (high >>> n) | (low << (32 - n)) : high;
    };
    return {
      forget: () => { hasHigh = false; },
      below: (bound) => {
        hasHigh = !hasHigh;
        if (hasHigh) step();
        return Math.floor((words[hasHigh ? 0 : 1] * bound) / 2 ** 32);
      },
    };
  }

  function drawWeights({ n, chunk, state, increment, strata }) {
    const drawer = makeDrawer(state, increment);
    const weights = strata.map(() => new Uint16Array(n));
    for (const stratum of unique(strata).sort((a, b) => a - b)) {
      const units = weights.filter((_, pair) => strata[pair] === stratum);
      for (let start = 0; start < n; start += chunk) {
        drawer.forget();
        for (let b = start; b < Math.min(start + chunk, n); b += 1) {
          for (let i = 0; i < units.length; i += 1) units[drawer.below(units.length)][b] += 1;
        }
      }
    }
    return weights;
  }

  /* Statistics */

  const creditOf = (p, label) => (p === null ? 0 : (1 + Math.sign(p - 0.5) * (label ? 1 : -1)) / 2);

  function sumByPair(trials, values, pairs) {
    const sums = new Map();
    for (const trial of trials) sums.set(pairs[trial], (sums.get(pairs[trial]) ?? 0) + values[trial]);
    return sums;
  }

  function addUp(sums, weights, n) {
    const total = new Float64Array(n);
    for (const [pair, value] of sums) {
      if (value) for (let b = 0; b < n; b += 1) total[b] += value * weights[pair][b];
    }
    return total;
  }

  function findInterval(values) {
    const ordered = values.sort();
    const last = ordered.length - 1;
    return TAILS.map((tail) => {
      const below = Math.floor(tail * last);
      const [lower, upper] = [ordered[below], ordered[Math.min(below + 1, last)]];
      return lower + (upper - lower) * (tail * last - below);
    });
  }

  /* Two-sided, over all patterns of signs; `differences` are whole numbers. */
  function findP(differences) {
    const sizes = differences.map(Math.abs);
    const [observed, all] = [Math.abs(sum(differences)), sum(sizes)];
    if (!observed) return 1;
    const shares = new Float64Array(all + 1).fill(1, 0, 1);
    for (const size of sizes.filter(Boolean)) {
      for (let s = all; s >= 0; s -= 1) shares[s] = (shares[s] + (s < size ? 0 : shares[s - size])) / 2;
    }
    return 2 * sum(shares.subarray((observed + all + 1) >> 1));
  }

  function findKappa(a, b) {
    const n = a.length;
    const [p, q] = [sum(a) / n, sum(b) / n];
    const chance = p * q + (1 - p) * (1 - q);
    const agreed = sum(a.map((value, index) => 1 - Math.abs(value - b[index]))) / n;
    if (n < 2) return [NOTHING, "", "undefined: there is but one trial"];
    const isCertain = p === q && (p === 0 || p === 1);
    if (isCertain) return [NOTHING, "", "undefined: both give one and the same answer to every trial"];
    return [show(settle((agreed - chance) / (1 - chance)), 3)];
  }

  /* Printing as the server does: half to even, where the binary number is a tie; no negative zero. */

  function show(value, digits, plus = "") {
    const [size, exact] = [Math.abs(value).toFixed(digits), Math.abs(value).toFixed(90)];
    const isTie = /^50*$/.test(exact.slice(exact.indexOf(".") + 1 + digits));
    const text = isTie && size.at(-1) % 2 ? (size - 10 ** -digits).toFixed(digits) : size;
    return (value < 0 && Number(text) ? MINUS : plus) + text;
  }

  /* The command rounds to six decimals before anything is printed. */
  const settle = (value) => Number(show(value, 6).replace(MINUS, "-"));
  const points = (value) => show(100 * settle(value), 1, "+");
  const grouped = (n) => n.toLocaleString("en-US");

  /* Comparing, scope by scope */

  const { trials, scopes, draws } = window.comparing;
  scopes.forEach((scope, index) => {
    scope.index = index;
    scope.trials = range(trials.id.length).filter((trial) => scope.strata.includes(trials.stratum[trial]));
  });
  let weights = null;

  function prepare({ p, scores }) {
    const credits = p.map((value, trial) => creditOf(value, trials.label[trial]));
    const answers = p.map((value) => creditOf(value ?? 0.5, 1));
    return { p, scores, credits, answers, accuracy: [] };
  }

  const weigh = (inside, values) => addUp(sumByPair(inside, values, trials.pair), weights, draws.n);

  /* The accuracy on the data and on every resample; overall it is the mean of the properties'. */
  function measure(contender, scope) {
    contender.accuracy[scope.index] ??= scope.parts
      ? average(scope.parts.map((part) => measure(contender, scopes[part])))
      : measureTrials(contender.credits, scope);
    return contender.accuracy[scope.index];
  }

  function average(parts) {
    const mean = (values) => sum(values) / parts.length;
    const resampled = parts[0].resampled.map((_, b) => mean(parts.map((part) => part.resampled[b])));
    return { value: mean(parts.map(({ value }) => value)), resampled };
  }

  function measureTrials(credits, scope) {
    const inside = scope.trials;
    weights ??= drawWeights(draws);
    scope.sizes ??= weigh(inside, credits.map(() => 1));
    const resampled = weigh(inside, credits).map((earned, b) => earned / scope.sizes[b]);
    return { value: sum(inside.map((trial) => credits[trial])) / inside.length, resampled };
  }

  function compare(a, b, scope) {
    const { trials: inside } = scope;
    const [x, y] = [a, b].map((contender) => measure(contender, scope));
    const halves = a.credits.map((credit, trial) => 2 * (credit - b.credits[trial]));
    const byPair = [...sumByPair(inside, halves, trials.pair).values()];
    const count = (isRight, isOtherRight) => inside.filter((trial) => (
      (a.credits[trial] === 1) === isRight && (b.credits[trial] === 1) === isOtherRight)).length;
    const favour = (sign) => byPair.filter((value) => Math.sign(value) === sign).length;
    const counts = [
      count(true, true), count(true, false), count(false, true), count(false, false),
      favour(1), favour(-1), favour(0),
    ];
    const p = findP(byPair);
    const answers = [a, b].map((contender) => inside.map((trial) => contender.answers[trial]));
    const ends = findInterval(x.resampled.map((value, i) => value - y.resampled[i]));
    return [
      [points(x.value - y.value), ends.map(points).join(" to ")],
      [p < 0.001 ? "< 0.001" : show(p, 3)],
      findKappa(...answers),
      ...counts.map((n) => [grouped(n)]),
    ];
  }

  /* Tables: text is always text, never markup. */

  function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  const place = document.querySelector(".compared");
  const { up } = place.dataset;

  function makeHeading([title, below = "", metric = ""]) {
    const name = metric ? make("a", { href: `${up}method.html#${metric}` }, title) : title;
    return make("th", { class: "number", scope: "col" }, name, make("small", {}, below));
  }

  const unseen = (text) => make("span", { class: "unseen" }, text);

  function makeCell([text, interval, why, nLeftOut]) {
    if (why) {
      return make("td", { class: "number absent" }, make("abbr", { title: why }, text), unseen(` ${why}`));
    }
    const cell = make("td", { class: "number" }, text);
    const mark = [make("sup", { "aria-hidden": "true" }, "*"), unseen(" some resamples left out")];
    if (interval) cell.append(make("small", { class: "interval" }, `\n${interval}`, ...(nLeftOut ? mark : [])));
    return cell;
  }

  /* What must be told of single numbers, below their table. */
  function listNotes(rows) {
    const cells = rows.flatMap(([, , cellsOfRow]) => cellsOfRow);
    const most = Math.max(0, ...cells.map(([, , , nLeftOut]) => nLeftOut ?? 0));
    const leftOut = `* resamples without a value are left out of the interval, ${grouped(most)} at most`;
    const reasons = unique(cells.map(([, , why]) => why).filter(Boolean)).map((why) => `${NOTHING} ${why}`);
    return [...reasons, ...(most ? [leftOut] : [])].map((note) => make("p", { class: "note" }, note));
  }

  function makeTable(title, note, first, headings, rows) {
    const id = `compared-${title.toLowerCase()}`;
    const makeName = (name, scope) => make("th", { class: "name", scope }, name);
    const head = make("tr", {}, makeName(first, "col"), ...headings.map(makeHeading));
    const body = rows.map(([name, level, cells]) => (
      make("tr", { class: `level-${level}` }, makeName(name, "row"), ...cells.map(makeCell))));
    const caption = make("caption", { id }, make("strong", {}, title), ` ${note}`);
    const parts = [caption, make("thead", {}, head), make("tbody", {}, ...body)];
    const box = { class: "scroll", role: "region", "aria-labelledby": id, tabindex: 0 };
    return [make("div", box, make("table", { class: "scores" }, ...parts)), ...listNotes(rows)];
  }

  function tabulateScores(contenders, shared) {
    const metrics = [["accuracy", "accuracy, %"], ["human_r", "human r"]].slice(0, trials.people ? 2 : 1);
    const headings = contenders.flatMap(({ letter }) => (
      metrics.map(([name, title]) => [`${letter}: ${title}`, "", name])));
    const rows = shared.map(({ index, title, level }) => (
      [title, level, contenders.flatMap(({ scores }) => scores[index])]));
    return makeTable("Scores", "As everywhere on this site, with 95 % intervals.", "Scope", headings, rows);
  }

  function tabulateDifferences(contenders, shared) {
    const couples = contenders.flatMap((a, index) => contenders.slice(index + 1).map((b) => [a, b]));
    const within = shared.filter(({ level }) => couples.length === 1 || level < 2);
    const rows = within.flatMap((scope) => couples.map(([a, b]) => (
      [`${scope.title}, ${a.letter} ${MINUS} ${b.letter}`, scope.level, compare(a, b, scope)])));
    const headings = [
      ["Accuracy", "points", "accuracy_difference"], ["Exact p", "", "paired_p"], ["Kappa", "", "rival_kappa"],
      ["Both right", "trials"], ["Only first", "trials"], ["Only second", "trials"], ["Neither", "trials"],
      ["First better", "pairs"], ["Second better", "pairs"], ["Equal", "pairs"],
    ];
    const note = "Accuracy of the first minus that of the second, with its 95 % interval. Overall is the mean of"
      + " the properties; its p pools their pairs.";
    return makeTable("Differences", note, "Scope", headings, rows);
  }

  function tabulateTrials(contenders) {
    const values = (trial) => contenders.map(({ p }) => p[trial]);
    const spread = (trial) => Math.max(...values(trial)) - Math.min(...values(trial));
    const found = range(trials.id.length).filter((trial) => !values(trial).includes(null));
    found.sort((a, b) => spread(b) - spread(a) || (trials.id[a] < trials.id[b] ? -1 : 1));
    const people = trials.people ? ["People"] : [];
    const headings = ["Label", ...contenders.map(({ letter }) => letter), ...people].map((title) => [title]);
    const rows = found.slice(0, N_TRIALS_SHOWN).map((trial) => {
      const shown = [...values(trial), ...people.map(() => trials.people[trial])];
      const cells = shown.map((p) => (p === null ? [NOTHING, "", "nobody judged it"] : [show(p, 3)]));
      const link = make("a", { href: `${up}${trials.path[trial]}` }, make("code", {}, trials.id[trial]));
      return [link, 2, [[trials.label[trial] ? "YES" : "NO"], ...cells]];
    });
    const note = "Those on which they differ most: probabilities of YES.";
    return makeTable("Trials", note, "Trial", headings, rows);
  }

  /* What is chosen: in the address, and on the page */

  const options = [...place.querySelector("template").content.children];
  const known = new Map(options.map(({ value, dataset }) => [value, dataset]));
  const list = make("ol", { class: "chosen", type: "A" });
  const said = make("p", { class: "note", role: "status" });
  const select = make("select", { id: "compared-other" }, ...options);
  const add = make("button", { type: "button" }, "Add");
  const results = make("div");
  const submitted = new Map();
  let chosen = [];

  function fetchAnswers(slug) {
    return new Promise((resolve, reject) => {
      const script = make("script", { src: up + known.get(slug).file });
      script.addEventListener("load", resolve);
      script.addEventListener("error", reject);
      document.head.append(script);
    }).then(() => prepare(window.contenders[slug]));
  }

  async function load(slug) {
    if (!submitted.has(slug)) submitted.set(slug, fetchAnswers(slug));
    try {
      return await submitted.get(slug);
    } catch {
      submitted.delete(slug); /* so that it is tried again */
      const { name } = known.get(slug);
      throw new Error(`What ${name} answered could not be loaded. Reload the page to try again.`);
    }
  }

  /* The answer that is waited for may not be wanted any more when it comes. */
  async function refresh(slugs, remark = "") {
    chosen = slugs;
    list.replaceChildren(...slugs.map(listOne));
    add.setAttribute("aria-disabled", slugs.length === MOST);
    results.replaceChildren();
    const tell = (...sentences) => { said.textContent = [remark, ...sentences].filter(Boolean).join(" "); };
    tell(slugs.length < 2 ? "Add two to six." : "Comparing\u2026");
    if (slugs.length < 2) return;
    try {
      const loaded = await Promise.all(slugs.map(load));
      if (slugs === chosen) tell(showAll(loaded.map((one, index) => ({ ...one, letter: LETTERS[index] }))));
    } catch (error) {
      if (slugs === chosen) tell(error.message);
    }
  }

  function listOne(slug) {
    const { name } = known.get(slug);
    const remove = make("button", { type: "button", "aria-label": `Remove ${name}, ${slug}` }, "Remove");
    remove.addEventListener("click", () => {
      choose(chosen.filter((other) => other !== slug));
      select.focus();
    });
    const link = make("a", { href: `${up}submissions/${slug}/index.html` }, name);
    return make("li", {}, link, " ", make("small", {}, slug), " ", remove);
  }

  function showAll(contenders) {
    const shared = scopes.filter(({ index }) => contenders.every(({ scores }) => scores[index]));
    if (!shared.length) return "They cover no scenario in common: there is nothing to compare.";
    const tables = [tabulateScores, tabulateDifferences].flatMap((tabulate) => tabulate(contenders, shared));
    results.append(...tables, ...tabulateTrials(contenders));
    const drawn = `${grouped(draws.n)} resamples of pairs, the same for all.`;
    return `${drawn} No p is corrected for the number of comparisons.`;
  }

  function choose(slugs) {
    refresh(slugs);
    try {
      history.pushState(null, "", `${location.pathname}${slugs.length ? "?of=" : ""}${slugs.join(",")}`);
    } catch {
      /* A page opened as a file may not be allowed to change its address. */
    }
  }

  function addChosen() {
    if (chosen.length === MOST) said.textContent = "Six are compared: remove one to add another.";
    else if (chosen.includes(select.value)) said.textContent = "It is compared already.";
    else choose([...chosen, select.value]);
  }

  /* Who is not here is said, since letters then stand for others than in the address. */
  function read() {
    const of = new URLSearchParams(location.search).get("of") ?? "";
    const named = unique(of.split(",").map((slug) => slug.trim()).filter(Boolean));
    const here = named.filter((slug) => known.has(slug));
    const nMissing = named.length - here.length;
    const missing = nMissing ? `Not on this site: ${grouped(nMissing)} of those in the address.` : "";
    const left = here.length > MOST ? "Only the first six are compared." : "";
    refresh(here.slice(0, MOST), missing || left);
  }

  const label = make("label", { for: select.id }, "Submission");
  const field = make("div", { class: "fields" }, make("div", { class: "field" }, label, select), add);
  place.querySelector(".without").replaceWith(list, field, said, results);
  add.addEventListener("click", addChosen);
  addEventListener("popstate", read);
  read();
})();
