/* What a board can do with JavaScript: sort, find, choose columns and what to compare, save the view.
   Everything to read is in the page without it, or in further pages, whose rows are in "boardRows" then.
   DataTables sorts, filters and hides columns; the state is in the address, and only what this page knows is
   taken from there. */
"use strict";

(() => {
  const MAX_TEXT = 100;
  const MOST_COMPARED = 6;
  const ROWS_A_PAGE = 100;
  const MILLION = 1e6;
  const N_DECIMALS = 6;
  const FORMULA_START = /^[=+\-@\t\r]/;
  const PART = /^[1-9]\d{0,5}$/;
  const DAY = /^\d{4}-\d{2}-\d{2}$/;
  const FIELDS = ["text", "family", "inputs", "from", "to"];
  const SORTED_BY_RANK = Object.freeze({ key: "rank", order: "asc" });

  /* Making elements: text is always text, never markup. */

  function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  /* Reading the table that the server wrote: rank and name stand before the groups of numbers. */

  function readColumns({ tHead }) {
    const [outer, inner] = [...tHead.rows].map((row) => [...row.querySelectorAll("[data-key]")]);
    const groups = [...tHead.querySelectorAll(".group")];
    const groupOf = groups.flatMap((group) => Array(group.colSpan).fill(group.textContent));
    return outer.toSpliced(2, 0, ...inner).map((heading, index) => ({
      index,
      heading,
      ...heading.dataset,
      isNumber: heading.matches(".number, .rank"),
      hasName: heading.matches(".name"),
      title: (heading.querySelector("a") ?? heading.firstChild).textContent.trim(),
      group: groupOf[inner.indexOf(heading)] ?? "",
    }));
  }

  const fold = (text) => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();

  /* What has no value has no key either. */
  function keyOf({ isNumber, hasName }, { exact, place } = {}, text) {
    const number = exact?.split(" ")[0] ?? place ?? null;
    return isNumber || hasName ? number && Number(number) : text || null;
  }

  function readRow(tr, columns, kind) {
    const { id: slug, dataset: { family = "", inputs = "", date = "" } } = tr;
    const cells = [...tr.cells];
    const texts = cells.map((cell) => cell.textContent.trim());
    const data = cells.map((cell) => cell.dataset);
    const keys = columns.map((column, index) => keyOf(column, data[index], texts[index]));
    const text = fold([slug, texts[1], family, inputs, date].join(" "));
    const name = cells[1].querySelector("a").textContent;
    return { tr, cells, kind, slug, name, family, inputs, date, text, keys, data };
  }

  function readRows(table, columns) {
    return [...table.tBodies].flatMap((body) =>
      [...body.rows]
        .filter((tr) => tr.cells.length === columns.length)
        .map((tr) => readRow(tr, columns, body.className)));
  }

  /* Reading the rows that are data only, and writing them as templates/board.html does. */

  function unpackExact(cell, row) {
    const parts = ["value", "low", "high"].map((part) => cell[part]?.[row] ?? "");
    const show = (part) => (typeof part === "number" ? (part / MILLION).toFixed(N_DECIMALS) : part);
    const data = {};
    if (parts[0] !== "") data.exact = parts.map(show).join(" ").trim();
    if (cell.undefined?.[row]) data.undefined = cell.undefined[row];
    return data;
  }

  function unpackRow(rows, row, columns) {
    const [slug, name, family, inputs, date, ranks] =
      ["slug", "name", "family", "inputs", "date", "ranks"].map((key) => rows.texts[rows[key][row]]);
    const [badges, details, facts] =
      ["badges", "details", "facts"].map((key) => rows[key][row].map((place) => rows.texts[place]));
    const numbers = rows.cells.map((cell) => unpackExact(cell, row));
    const data = [{ place: rows.rank[row] }, { place: rows.place[row] }, ...numbers];
    const keys = columns.map((column, index) => keyOf(column, data[index], facts[index - data.length]));
    const text = fold([slug, name, ...badges, ...details, family, inputs, date].join(" "));
    const fill = (cells, up) => {
      cells.forEach((cell, index) => Object.assign(cell.dataset, data[index]));
      const [rankCell, nameCell, ...others] = cells;
      fillRank(rankCell, rows.rank[row], ranks);
      fillName(nameCell, `${up}submissions/${slug}/index.html`, name, badges, details);
      for (const cell of rows.cells) fillNumber(others.shift(), cell, row, rows.texts);
      for (const fact of facts) fillCell(others.shift(), "fact", fact);
    };
    return { kind: "ranked", slug, name, family, inputs, date, text, keys, data, fill };
  }

  function unpackRows(rows, columns) {
    return rows ? rows.slug.map((_, row) => unpackRow(rows, row, columns)) : [];
  }

  const small = (name, ...content) => make("small", { class: name }, ...content);
  const unseen = (text) => make("span", { class: "unseen" }, text);
  const mark = (note) => make("sup", { "aria-hidden": "true" }, note);

  function fillCell(cell, name, ...content) {
    cell.className = name;
    cell.append(...content);
  }

  function fillRank(td, rank, ranks) {
    fillCell(td, "rank", rank);
    if (ranks) td.append(small("interval", `\n${ranks}`));
  }

  function fillName(th, href, name, badges, details) {
    th.scope = "row";
    fillCell(th, "name", make("a", { href }, name));
    for (const badge of badges) th.append(" ", make("span", { class: "badge" }, badge));
    for (const detail of details) th.append(" ", make("small", {}, detail));
  }

  function fillNumber(td, cell, row, texts) {
    const [text, interval, remark, why] =
      ["text", "interval", "remark", "why"].map((name) => texts[cell[name]?.[row] ?? 0]);
    const note = cell.note?.[row];
    if (why) {
      fillCell(td, "number absent", make("abbr", { title: why }, text), mark(note), unseen(` ${why}`));
      return;
    }
    const noted = note ? [mark(note), unseen(" some resamples left out")] : [];
    fillCell(td, "number", text);
    if (interval) td.append(small("interval", `\n${interval}`, ...noted));
    if (remark) td.append(small("remark", `\n${remark}`));
  }

  /* The exact value, for a pointer that rests on it: in every cell beforehand they made a fourth of the page. */
  function nameExactly({ target }) {
    const cell = target.closest("td[data-exact]");
    if (!cell || cell.title) return;
    const { exact, undefined: nUndefined } = cell.dataset;
    const [value, low, high] = exact.split(" ");
    const interval = low ? `, 95 % interval ${low} to ${high}` : "";
    const n = Number(nUndefined ?? 0).toLocaleString("en-US");
    cell.title = value + interval + (nUndefined ? `, ${n} resamples without a value` : "");
  }

  const distinct = (rows, name) => [...new Set(rows.map((row) => row[name]).filter(Boolean))].sort();

  /* The state, and how it is written into the address. */

  function isDay(text) {
    return DAY.test(text) && !Number.isNaN(Date.parse(text));
  }

  function parseSort(text, columns) {
    const [key, order, ...rest] = text.split(":");
    const isKnown = columns.some((column) => column.key === key);
    return isKnown && (order === "asc" || order === "desc") && !rest.length ? { key, order } : SORTED_BY_RANK;
  }

  /* Whatever is not known here counts as not said. */
  function parseState(search, known) {
    const said = new URLSearchParams(search);
    const one = (name, accepts) => (accepts(said.get(name) ?? "") ? said.get(name) : "");
    const list = (name, values) => {
      const named = (said.get(name) ?? "").split(",");
      return [...new Set(named.filter((value) => values.includes(value)))];
    };
    const hidden = list("hide", known.hideable);
    const sort = parseSort(said.get("sort") ?? "", known.columns);
    return {
      text: (said.get("find") ?? "").slice(0, MAX_TEXT),
      family: one("family", (value) => known.family.includes(value)),
      inputs: one("inputs", (value) => known.inputs.includes(value)),
      from: one("from", isDay),
      to: one("to", isDay),
      hidden,
      chosen: list("compare", known.slugs).slice(0, MOST_COMPARED),
      part: Number(one("page", (value) => PART.test(value) && value <= known.nParts)) || 1,
      sort: hidden.includes(sort.key) ? SORTED_BY_RANK : sort,
    };
  }

  function writeState(state) {
    const said = {
      find: state.text,
      family: state.family,
      inputs: state.inputs,
      from: state.from,
      to: state.to,
      sort: `${state.sort.key}:${state.sort.order}`.replace(/^rank:asc$/, ""),
      hide: state.hidden.join(","),
      compare: state.chosen.join(","),
      page: state.part > 1 ? String(state.part) : "",
    };
    const query = new URLSearchParams(Object.entries(said).filter(([, value]) => value)).toString();
    return query.replaceAll("%2C", ",").replaceAll("%3A", ":");
  }

  /* Sorting: partial submissions come after the others, what has no value comes last in both directions, and
     equals keep the order of the page. */

  function compareKeys([isPartialA, a], [isPartialB, b], sign) {
    if (isPartialA !== isPartialB) return isPartialA ? 1 : -1;
    if (a === b) return 0;
    if (a === null) return 1;
    if (b === null) return -1;
    return a < b ? -sign : sign;
  }

  function matcher(state) {
    const words = fold(state.text).split(/\s+/);
    return (row) => words.every((word) => row.text.includes(word))
      && (!state.family || row.family === state.family)
      && (!state.inputs || row.inputs === state.inputs)
      && (!state.from || row.date >= state.from)
      && (!state.to || row.date <= state.to);
  }

  /* The file of what is shown. */

  function quoteCell(value, { isText = false } = {}) {
    const text = isText && FORMULA_START.test(value) ? `'${value}` : value;
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  }

  function renderCsv(rows, columns) {
    const numbers = columns.filter((column) => column.heading.classList.contains("number"));
    const header = ["kind", "rank", "slug", "name", "family", "inputs", "date"];
    header.push(...numbers.flatMap(({ key }) => [key, `${key}.low`, `${key}.high`]));
    const lines = rows.map((row) => {
      const texts = [row.slug, row.name, row.family, row.inputs, row.date];
      return [
        row.kind,
        row.keys[0] ?? "",
        ...texts.map((text) => quoteCell(text, { isText: true })),
        ...numbers.flatMap(({ index }) => {
          const [value, low = "", high = ""] = (row.data[index].exact ?? "").split(" ");
          return [value, low, high];
        }),
      ].join(",");
    });
    return [header.map((name) => quoteCell(name)).join(","), ...lines, ""].join("\n");
  }

  function download(name, text) {
    const address = URL.createObjectURL(new Blob([text], { type: "text/csv;charset=utf-8" }));
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 0);
  }

  /* A board and its controls. */

  class Board {
    constructor(table, place) {
      this.table = table;
      this.columns = readColumns(table);
      this.more = unpackRows(window.boardRows, this.columns);
      this.all = [...readRows(table, this.columns), ...this.more];
      this.bySlug = new Map(this.all.map((row) => [row.slug, row]));
      const isPinned = ({ kind }) => kind !== "ranked" && kind !== "partial";
      this.pinned = this.all.filter(isPinned);
      this.rows = this.all.filter((row) => !isPinned(row));
      if (!this.rows.length) return;
      this.makeControls(place);
      this.known = this.listKnown();
      this.offerChoices();
      this.state = parseState(location.search, this.known);
      this.pairs = new Set(table.dataset.pairs.split(" "));
      this.makeTurner();
      this.markHeadings();
      this.markRows();
      this.startTable();
      this.show();
      this.listen();
      this.returnToTarget();
    }

    makeControls(place) {
      const find = (found) => place.querySelector(found);
      place.replaceChildren(find("template").content);
      this.fields = Object.fromEntries(FIELDS.map((name) => [name, find(`[name=${name}]`)]));
      this.boxes = [...place.querySelectorAll("[type=checkbox]")];
      [this.menu, this.csv, this.count, this.paper, this.reset, this.tray] =
        [".menu", ".csv", ".count", ".paper", ".reset", ".tray"].map(find);
      this.foldWhereNarrow(find(".finder"));
    }

    listKnown() {
      return {
        columns: this.columns,
        hideable: this.boxes.map((box) => box.value),
        family: distinct(this.rows, "family"),
        inputs: distinct(this.rows, "inputs"),
        slugs: this.all.map((row) => row.slug).filter(Boolean),
        nParts: this.more.length ? Math.ceil(this.rows.length / ROWS_A_PAGE) : 1,
      };
    }

    offerChoices() {
      for (const name of ["family", "inputs"]) {
        this.fields[name].append(...this.known[name].map((value) => make("option", { value }, value)));
      }
    }

    foldWhereNarrow(finder) {
      const narrow = matchMedia("(max-width: 70rem)");
      const open = () => { finder.open = !narrow.matches; };
      narrow.addEventListener("change", open);
      open();
    }

    /* In place of the links to further pages, whose rows are all here. */
    makeTurner() {
      if (!this.more.length) return;
      this.turner = document.querySelector(".parts");
      this.turner.replaceChildren(this.turner.querySelector("template").content);
      [this.parts, this.back, this.next] = this.turner.querySelectorAll("select, button");
      this.back.addEventListener("click", () => this.turnTo(this.state.part - 1));
      this.next.addEventListener("click", () => this.turnTo(this.state.part + 1));
      this.parts.addEventListener("input", () => this.turnTo(Number(this.parts.value)));
    }

    markHeadings() {
      for (const column of this.columns) {
        const button = make("button", { type: "button", class: "sort" });
        column.button = button;
        column.heading.abbr = column.title; /* what a screen reader says with each cell, without the button */
        column.heading.append(button);
      }
    }

    markRows() {
      for (const row of this.all) if (row.slug && row.tr) this.markRow(row);
    }

    markRow(row) {
      row.box = make("input", { type: "checkbox", class: "choose", "aria-label": `Compare ${row.name}` });
      row.cells[1].abbr = row.name;
      row.cells[1].append(row.box);
    }

    /* A row that is data only comes into being when it is shown for the first time. */
    writeRow(row, tr, cells) {
      Object.assign(row, { tr, cells });
      tr.id = row.slug;
      Object.assign(tr.dataset, { family: row.family, inputs: row.inputs, date: row.date });
      row.fill(cells, this.table.dataset.up);
      this.markRow(row);
      row.box.checked = this.state.chosen.includes(row.slug);
    }

    /* DataTables takes the first body of a table: those that stay where they are step aside meanwhile. */
    startTable() {
      const bodies = [...this.table.tBodies];
      this.main = bodies.find((body) => body.className === "ranked");
      this.partial = bodies.find((body) => body.className === "partial");
      const single = bodies.flatMap((body) => [...body.rows]).filter((tr) => tr.cells.length === 1);
      this.spanning = single.map((tr) => tr.cells[0]);
      for (const group of this.table.tHead.querySelectorAll("th.group")) group.dataset.dtOrder = "disable";
      const index = bodies.indexOf(this.main);
      bodies.forEach((body) => body.remove());
      this.note = [...this.main.rows].find((tr) => tr.cells.length === 1);
      this.main.replaceChildren(...this.rows.flatMap((row) => row.tr ?? []));
      this.table.append(this.main);
      this.registerOrder();
      this.data = new DataTable(this.table, this.options());
      const nothing = this.columns.map(() => "");
      if (this.more.length) this.data.rows.add(this.more.map(() => nothing));
      this.main.before(...bodies.slice(0, index));
      this.main.after(...bodies.slice(index + 1));
    }

    registerOrder() {
      const { ext } = DataTable;
      ext.order.board = (_, index) => this.rows.map((row) => [row.kind === "partial", row.keys[index]]);
      ext.type.order["board-asc"] = (a, b) => compareKeys(a, b, 1);
      ext.type.order["board-desc"] = (a, b) => compareKeys(a, b, -1);
    }

    options() {
      return {
        autoWidth: false,
        paging: this.more.length > 0,
        pageLength: ROWS_A_PAGE,
        createdRow: (tr, _, index, cells) => {
          if (!this.rows[index].tr) this.writeRow(this.rows[index], tr, cells);
        },
        layout: { topStart: null, topEnd: null, bottomStart: null, bottomEnd: null },
        ordering: { handler: false, indicators: false },
        orderClasses: false,
        orderDescReverse: false,
        typeDetect: false,
        columns: this.columns.map(({ hasName }) => (
          { type: "board", orderDataType: "board", searchable: false, cellType: hasName ? "th" : "td" })),
        language: { zeroRecords: "No submission fits." },
        on: { draw: () => this.place() },
      };
    }

    /* Partial submissions are sorted and filtered with the others, and stand in their own body. */
    place() {
      if (!this.partial) return;
      const shown = [...this.main.rows].filter(({ id }) => this.bySlug.get(id)?.kind === "partial");
      const divider = this.partial.querySelector(".divider");
      this.partial.replaceChildren(divider, ...shown);
      this.partial.hidden = !shown.length;
      const hasRanked = this.data && this.shownRows().some(({ kind }) => kind === "ranked");
      if (!this.main.rows.length && !hasRanked) this.main.append(this.note ?? this.makeNote());
    }

    makeNote() {
      const text = make("span", {}, "No complete submission fits.");
      return make("tr", {}, make("td", { class: "none", colspan: this.nVisible() }, text));
    }

    nVisible() {
      return this.columns.length - this.state.hidden.length;
    }

    /* Show what the state says, everywhere. */
    show() {
      const { state, data } = this;
      for (const [name, field] of Object.entries(this.fields)) {
        if (field.value !== state[name]) field.value = state[name];
      }
      for (const box of this.boxes) box.checked = !state.hidden.includes(box.value);
      this.hideColumns();
      const matches = matcher(state);
      data.search.fixed("board", (_, __, index) => matches(this.rows[index]));
      const { index } = this.columns.find(({ key }) => key === state.sort.key);
      data.order([index, state.sort.order]).draw();
      this.turn();
      this.markOrder();
      this.tell();
      this.showChosen();
    }

    /* Show the part that the state says, or the last one there is. */
    turn() {
      if (!this.turner) return;
      const n = this.shownRows().length;
      const nParts = Math.max(1, Math.ceil(n / ROWS_A_PAGE));
      this.state.part = Math.min(this.state.part, nParts);
      const { part } = this.state;
      if (this.data.page() !== part - 1) this.data.page(part - 1).draw("page");
      const name = (_, index) => {
        const last = Math.min(n, (index + 1) * ROWS_A_PAGE);
        return make("option", { value: index + 1 }, `${index * ROWS_A_PAGE + 1} to ${last}`);
      };
      if (this.nOffered !== n) this.parts.replaceChildren(...Array.from({ length: nParts }, name));
      this.nOffered = n;
      this.parts.value = part;
      this.back.setAttribute("aria-disabled", part === 1);
      this.next.setAttribute("aria-disabled", part === nParts);
      this.turner.hidden = nParts === 1;
      const rows = this.parts.selectedOptions[0].text;
      this.paper.textContent = nParts > 1 ? `Here: rows ${rows} of ${n}. All are in leaderboard.csv.` : "";
    }

    turnTo(part) {
      if (part < 1 || part > this.parts.length) return;
      this.state.part = part;
      this.turn();
      this.remember();
      this.table.parentNode.scrollTop = 0;
    }

    hideColumns() {
      for (const { key, index } of this.columns) {
        const isShown = !this.state.hidden.includes(key);
        if (this.data.column(index).visible() !== isShown) this.data.column(index).visible(isShown, false);
        for (const row of this.pinned) row.cells[index].hidden = !isShown;
      }
      for (const cell of this.spanning) cell.colSpan = this.nVisible();
    }

    markOrder() {
      for (const { key, title, group, button } of this.columns) {
        const order = this.state.sort.key === key ? this.state.sort.order : "";
        button.dataset.order = order;
        const said = { asc: ", ascending now", desc: ", descending now" }[order] ?? "";
        button.setAttribute("aria-label", `Sort by ${group && group !== title ? `${group} ` : ""}${title}${said}`);
      }
    }

    shownRows() {
      const indexes = this.data.rows({ order: "current", search: "applied" }).indexes().toArray();
      return indexes.map((index) => this.rows[index]);
    }

    tell() {
      const [n, all] = [this.shownRows().length, this.rows.length];
      const what = all === 1 ? "submission" : "submissions";
      this.count.value = n === all ? `All ${all} ${what}` : `${n} of ${all} ${what}`;
      this.reset.hidden = FIELDS.every((name) => !this.state[name]);
    }

    showChosen() {
      const chosen = this.state.chosen.map((slug) => this.bySlug.get(slug));
      for (const row of this.all) if (row.box) row.box.checked = chosen.includes(row);
      this.tray.replaceChildren(...this.describeChosen(chosen));
    }

    describeChosen(chosen) {
      if (!chosen.length) return ["Tick two to six to compare them."];
      if (chosen.length === 1) return [`${chosen[0].name}: tick others to compare it with.`];
      const slugs = chosen.map(({ slug }) => slug);
      const keys = [slugs, slugs.toReversed()].map((two) => two.join("--vs--"));
      const pair = keys.find((key) => this.pairs.has(key));
      const page = pair ? `${pair}/index.html` : `index.html?of=${slugs.join(",")}`;
      const names = chosen.map(({ name }) => name).join(chosen.length === 2 ? " with " : ", ");
      return [make("a", { href: `${this.table.dataset.up}compare/${page}` }, `Compare ${names}`)];
    }

    /* Change the state; what is typed letter by letter is one step back, not many. */
    change(changes, kind = "") {
      Object.assign(this.state, { part: 1 }, changes);
      this.show();
      this.remember(kind);
    }

    remember(kind = "") {
      const query = writeState(this.state);
      const address = `${location.pathname}${query && "?"}${query}${location.hash}`;
      const isSameStep = kind !== "" && kind === this.lastKind;
      this.lastKind = kind;
      try {
        history[isSameStep ? "replaceState" : "pushState"](null, "", address);
      } catch {
        /* A page opened as a file may not be allowed to change its address: the board works without. */
      }
    }

    listen() {
      for (const [name, field] of Object.entries(this.fields)) {
        const kind = field.matches("input") ? name : "";
        field.addEventListener("input", () => this.change({ [name]: field.value.slice(0, MAX_TEXT) }, kind));
      }
      for (const box of this.boxes) box.addEventListener("change", () => this.chooseColumns());
      this.table.addEventListener("change", ({ target }) => {
        if (target.matches(".choose")) this.choose(target.closest("tr").id, target.checked);
      });
      this.reset.addEventListener("click", () => {
        this.change(Object.fromEntries(FIELDS.map((name) => [name, ""])));
        this.fields.text.focus();
      });
      this.csv.addEventListener("click", () => this.save());
      for (const column of this.columns) column.button.addEventListener("click", () => this.sortBy(column));
      this.listenToMenu();
      addEventListener("popstate", () => {
        this.lastKind = "";
        this.state = parseState(location.search, this.known);
        this.show();
      });
    }

    listenToMenu() {
      this.menu.addEventListener("keydown", (event) => {
        if (event.key !== "Escape" || !this.menu.open) return;
        this.menu.open = false;
        this.menu.querySelector("summary").focus();
      });
      document.addEventListener("click", (event) => {
        if (!this.menu.contains(event.target)) this.menu.open = false;
      });
    }

    sortBy({ key, first }) {
      const { sort } = this.state;
      const order = sort.key !== key ? first : { asc: "desc", desc: "asc" }[sort.order];
      this.change({ sort: { key, order } });
    }

    chooseColumns() {
      const hidden = this.boxes.filter((box) => !box.checked).map((box) => box.value);
      const sort = hidden.includes(this.state.sort.key) ? SORTED_BY_RANK : this.state.sort;
      this.change({ hidden, sort });
    }

    choose(slug, isChosen) {
      const others = this.state.chosen.filter((other) => other !== slug);
      this.state.chosen = isChosen ? [...others.slice(1 - MOST_COMPARED), slug] : others;
      this.showChosen();
      this.remember();
    }

    save() {
      const shown = this.shownRows();
      const of = (kind, rows) => rows.filter((row) => row.kind === kind);
      const rows = [
        ...of("people", this.pinned), ...of("ranked", shown), ...of("partial", shown), ...of("baseline", this.pinned),
      ];
      const columns = this.columns.filter(({ key }) => !this.state.hidden.includes(key));
      download("leaderboard-view.csv", renderCsv(rows, columns));
    }

    /* Rows have moved in the document, which makes a browser forget the one that the address names. */
    returnToTarget() {
      const row = this.bySlug.get(location.hash.slice(1));
      if (!row?.slug) return;
      const place = this.turner ? this.shownRows().indexOf(row) : -1;
      if (place >= 0) {
        this.state.part = Math.floor(place / ROWS_A_PAGE) + 1;
        this.turn();
        this.lastKind = "target"; /* no step to go back to: the address as it came would lead here again */
        this.remember("target");
      }
      if (row.tr) location.replace(location.hash);
    }
  }

  const table = document.querySelector("table.board");
  table.addEventListener("mouseover", nameExactly);
  const place = document.querySelector(".controls");
  if (place && window.DataTable) new Board(table, place);
})();
