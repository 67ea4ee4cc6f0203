/* What a board can do with JavaScript: sort, find, choose columns, compare two, and download what is shown.
   Everything to read is in the page without it, or in further pages, whose rows are in "boardRows" then. DataTables sorts, filters and hides columns; the state is in
   the address, and only what this page knows is taken from there. */
"use strict";

(() => {
  const MAX_TEXT = 100;
  const ROWS_A_PAGE = 100;
  const MILLION = 1e6;
  const N_DECIMALS = 6;
  const FORMULA_START = /^[=+\-@\t\r]/;
  const PART = /^[1-9]\d{0,5}$/;
  const DAY = /^\d{4}-\d{2}-\d{2}$/;
  const SORTED_BY_RANK = Object.freeze({ key: "rank", order: "asc" });

  /* Making elements: text is always text, never markup. */

  function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
      if (value !== null) element.setAttribute(key, value);
    }
    element.append(...children);
    return element;
  }

  function labelled(text, control) {
    control.id = `board-${text.toLowerCase()}`;
    return make("div", { class: "field" }, make("label", { for: control.id }, text), control);
  }

  function choice(all, values) {
    const options = values.map((value) => make("option", { value }, value));
    return make("select", {}, make("option", { value: "" }, all), ...options);
  }

  /* Reading the table that the server wrote. */

  function readColumns(table) {
    const headings = [...table.tHead.querySelectorAll("th[data-key]")];
    const isTop = (heading) => heading.rowSpan > 1;
    const groups = [...table.tHead.querySelectorAll("th.group")];
    const before = headings.filter((heading) => isTop(heading) && !heading.matches(".fact"));
    const within = headings.filter((heading) => !isTop(heading));
    const after = headings.filter((heading) => heading.matches(".fact"));
    const groupOf = groups.flatMap((group) => Array(group.colSpan).fill(group.textContent));
    return [...before, ...within, ...after].map((heading, index) => ({
      index,
      heading,
      key: heading.dataset.key,
      first: heading.dataset.first,
      isNumber: heading.matches(".number, .rank"),
      hasName: heading.classList.contains("name"),
      title: (heading.querySelector("a") ?? heading.firstChild).textContent.trim(),
      group: groupOf[within.indexOf(heading)] ?? "",
    }));
  }

  const fold = (text) => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();

  function sortKey(cell, column) {
    const text = cell.dataset.value ?? cell.dataset.place;
    if (column.isNumber || column.hasName) return text === undefined ? null : Number(text);
    return cell.textContent.trim() || null;
  }

  function readRow(tr, columns, kind) {
    const cells = [...tr.cells];
    const name = cells[1];
    const link = name.querySelector("a");
    const { family = "", inputs = "", date = "" } = tr.dataset;
    const text = fold([tr.id, name.textContent, family, inputs, date].join(" "));
    const keys = columns.map((column) => sortKey(cells[column.index], column));
    const exact = cells.map(({ dataset: { value = "", low = "", high = "" } }) => [value, low, high]);
    return { tr, cells, kind, slug: tr.id, name: link.textContent, family, inputs, date, text, keys, exact };
  }

  function readRows(table, columns) {
    return [...table.tBodies].flatMap((body) =>
      [...body.rows]
        .filter((tr) => tr.cells.length === columns.length)
        .map((tr) => readRow(tr, columns, body.className)));
  }

  /* Reading the rows that are data only, and writing them as templates/board.html does. */

  function showExactly(value) {
    return typeof value === "number" ? (value / MILLION).toFixed(N_DECIMALS) : value ?? "";
  }

  const unpackExact = (cell, row) => ["value", "low", "high"].map((name) => showExactly(cell[name]?.[row]));

  function unpackCell(cell, row, texts) {
    const [text, interval, remark, why] =
      ["text", "interval", "remark", "why"].map((name) => texts[cell[name]?.[row] ?? 0]);
    const [nUndefined, note] = [cell.undefined?.[row] ?? 0, cell.note?.[row] ?? 0];
    return { text, interval, remark, why, nUndefined, note, exact: unpackExact(cell, row) };
  }

  function unpackRow(data, row, columns) {
    const [slug, name, family, inputs, date, ranks] =
      ["slug", "name", "family", "inputs", "date", "ranks"].map((key) => data.texts[data[key][row]]);
    const [badges, details, facts] =
      ["badges", "details", "facts"].map((key) => data[key][row].map((place) => data.texts[place]));
    const rank = data.rank[row] || null;
    const exact = [[], [], ...data.cells.map((cell) => unpackExact(cell, row))];
    const keys = columns.map(({ index, isNumber, hasName }) => {
      if (hasName) return data.place[row];
      if (index === 0) return rank;
      if (isNumber) return exact[index][0] === "" ? null : Number(exact[index][0]);
      return facts[index - exact.length] || null;
    });
    const text = fold([slug, name, ...badges, ...details, family, inputs, date].join(" "));
    const print = () => {
      const numbers = data.cells.map((cell) => unpackCell(cell, row, data.texts));
      return { rank, ranks, badges, details, numbers, facts };
    };
    return { kind: "ranked", slug, name, family, inputs, date, text, keys, exact, print };
  }

  function unpackRows(data, columns) {
    return data ? data.slug.map((_, row) => unpackRow(data, row, columns)) : [];
  }

  function describeExactly({ exact: [value, low, high], nUndefined }) {
    const parts = [value];
    if (low) parts.push(`95 % interval ${low} to ${high}`);
    if (nUndefined) parts.push(`${nUndefined.toLocaleString("en-US")} resamples without a value`);
    return parts.join(", ");
  }

  const small = (name, ...content) => make("small", { class: name }, ...content);
  const unseen = (text) => make("span", { class: "unseen" }, text);
  const mark = (note) => make("sup", { "aria-hidden": "true" }, note);

  function fillNumber(td, cell) {
    const { text, interval, remark, why, note, exact: [value, low, high] } = cell;
    td.className = why ? "number absent" : "number";
    if (why) {
      td.append(make("abbr", { title: why }, text), mark(note), unseen(` ${why}`));
      return;
    }
    Object.assign(td.dataset, low ? { value, low, high } : { value });
    td.title = describeExactly(cell);
    td.append(make("span", { class: "score" }, text));
    const noted = note ? [mark(note), unseen(" some resamples left out")] : [];
    if (interval) td.append(small("interval", ` ${interval}`, ...noted));
    if (remark) td.append(small("remark", ` ${remark}`));
  }

  function fillRank(td, { rank, ranks }) {
    td.className = "rank";
    if (rank) td.dataset.place = rank;
    td.append(String(rank ?? ""));
    if (ranks) td.append(small("interval", ` ${ranks}`));
  }

  function fillName(th, row, { badges, details }, up) {
    th.className = "name";
    th.scope = "row";
    th.dataset.place = row.keys[1];
    th.append(make("a", { href: `${up}submissions/${row.slug}/index.html` }, row.name));
    for (const badge of badges) th.append(" ", make("span", { class: "badge" }, badge));
    for (const detail of details) th.append(" ", make("small", {}, detail));
  }

  function fillRow(row, up) {
    const printed = row.print();
    const [rank, name, ...others] = row.cells;
    fillRank(rank, printed);
    fillName(name, row, printed, up);
    printed.numbers.forEach((number, index) => fillNumber(others[index], number));
    printed.facts.forEach((fact, index) => {
      const td = others[printed.numbers.length + index];
      td.className = "fact";
      td.append(fact);
    });
  }

  const distinct = (rows, name) => [...new Set(rows.map((row) => row[name]).filter(Boolean))].sort();

  /* The state, and how it is written into the address. */

  function emptyState() {
    const nothing = { text: "", family: "", inputs: "", from: "", to: "" };
    return { ...nothing, hidden: [], chosen: [], sort: SORTED_BY_RANK, part: 1 };
  }

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
      family: one("family", (value) => known.families.includes(value)),
      inputs: one("inputs", (value) => known.inputs.includes(value)),
      from: one("from", isDay),
      to: one("to", isDay),
      hidden,
      chosen: list("compare", known.slugs).slice(0, 2),
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
        ...numbers.flatMap(({ index }) => row.exact[index]),
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
      this.known = this.listKnown();
      this.state = parseState(location.search, this.known);
      this.pairs = new Set(table.dataset.pairs.split(" "));
      this.makeControls(place);
      this.makeTurner();
      this.markHeadings();
      this.markRows();
      this.startTable();
      this.show();
      this.listen();
      this.returnToTarget();
    }

    listKnown() {
      const hideable = this.columns.filter((column) => column.key !== "rank" && !column.hasName);
      return {
        columns: this.columns,
        hideable: hideable.map((column) => column.key),
        families: distinct(this.rows, "family"),
        inputs: distinct(this.rows, "inputs"),
        slugs: this.all.map((row) => row.slug).filter(Boolean),
        nParts: this.more.length ? Math.ceil(this.rows.length / ROWS_A_PAGE) : 1,
      };
    }

    makeControls(place) {
      const { families, inputs } = this.known;
      this.fields = {
        text: make("input", { type: "search", maxlength: MAX_TEXT, autocomplete: "off", spellcheck: "false" }),
        family: choice("all", families),
        inputs: choice("all", inputs),
        from: make("input", { type: "date" }),
        to: make("input", { type: "date" }),
      };
      this.count = make("output", { class: "count", "aria-live": "polite" });
      this.reset = make("button", { type: "button" }, "Show all");
      this.tray = make("p", { class: "tray", "aria-live": "polite" });
      this.csv = make("button", { type: "button" }, "CSV of this view");
      place.setAttribute("role", "group");
      place.setAttribute("aria-label", "Rows and columns");
      const fields = make("div", { class: "fields" },
        labelled("Find", this.fields.text),
        labelled("Family", this.fields.family),
        labelled("Inputs", this.fields.inputs),
        labelled("From", this.fields.from),
        labelled("To", this.fields.to),
        this.makeMenu(),
        this.csv);
      const summary = make("summary", {}, "Find, filter, choose columns");
      const finder = make("details", { class: "finder" }, summary, fields);
      place.append(finder, make("div", { class: "said" }, this.count, this.reset, this.tray));
      this.foldWhereNarrow(finder);
    }

    foldWhereNarrow(finder) {
      const narrow = matchMedia("(max-width: 70rem)");
      const fold = () => { finder.open = !narrow.matches; };
      narrow.addEventListener("change", fold);
      fold();
    }

    /* In place of the links to further pages, whose rows are all here. */
    makeTurner() {
      if (!this.more.length) return;
      this.turner = document.querySelector("nav.parts");
      this.back = make("button", { type: "button" }, "Previous");
      this.next = make("button", { type: "button" }, "Next");
      this.parts = make("select", {});
      const parts = make("div", { class: "turner" }, labelled("Rows", this.parts), this.back, this.next);
      this.turner.replaceChildren(parts);
      this.back.addEventListener("click", () => this.turnTo(this.state.part - 1));
      this.next.addEventListener("click", () => this.turnTo(this.state.part + 1));
      this.parts.addEventListener("input", () => this.turnTo(Number(this.parts.value)));
    }

    makeMenu() {
      const hideable = this.columns.filter((column) => this.known.hideable.includes(column.key));
      this.boxes = hideable.map((column) => {
        const box = make("input", { type: "checkbox", value: column.key });
        const title = column.group ? `${column.group}: ${column.title}` : column.title;
        return [box, make("label", { class: "option" }, box, make("span", {}, title))];
      });
      const list = make("div", { class: "list", role: "group", "aria-label": "Columns to show" });
      list.append(...this.boxes.map(([, label]) => label));
      this.menu = make("details", { class: "menu" }, make("summary", {}, "Columns"), list);
      return this.menu;
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
      fillRow(row, this.table.dataset.up);
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
        orderMulti: false,
        orderClasses: false,
        orderDescReverse: false,
        typeDetect: false,
        order: [[0, "asc"]],
        columns: this.columns.map(({ hasName }) => (
          { type: "board", orderDataType: "board", searchable: false, cellType: hasName ? "th" : "td" })),
        language: { zeroRecords: "No submission fits.", emptyTable: "No submission fits." },
        on: { draw: () => this.place() },
      };
    }

    /* Partial submissions are sorted and filtered with the others, and stand in their own body. */
    place() {
      if (!this.partial) return;
      const shown = this.rows.filter(({ kind, tr }) => kind === "partial" && tr.parentNode === this.main);
      shown.sort((a, b) => (a.tr.compareDocumentPosition(b.tr) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1));
      const divider = this.partial.querySelector(".divider");
      this.partial.replaceChildren(divider, ...shown.map((row) => row.tr));
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
      for (const [box] of this.boxes) box.checked = !state.hidden.includes(box.value);
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
      const { text, family, inputs, from, to } = this.state;
      const [n, all] = [this.shownRows().length, this.rows.length];
      const what = all === 1 ? "submission" : "submissions";
      this.count.value = n === all ? `All ${all} ${what}` : `${n} of ${all} ${what}`;
      this.reset.hidden = ![text, family, inputs, from, to].some(Boolean);
    }

    showChosen() {
      const chosen = this.state.chosen.map((slug) => this.bySlug.get(slug));
      for (const row of this.all) if (row.box) row.box.checked = chosen.includes(row);
      this.tray.replaceChildren(...this.describeChosen(chosen));
    }

    describeChosen(chosen) {
      if (!chosen.length) return ["Tick two to compare them."];
      if (chosen.length === 1) return [`${chosen[0].name}: tick another to compare it with.`];
      const [a, b] = chosen;
      const keys = [`${a.slug}--vs--${b.slug}`, `${b.slug}--vs--${a.slug}`];
      const pair = keys.find((key) => this.pairs.has(key));
      if (!pair) {
        const command = make("code", {}, `leaderboard compare ${a.slug} ${b.slug}`);
        return ["Not compared here. On your machine: ", command];
      }
      const href = `${this.table.dataset.up}compare/${pair}/index.html`;
      return [make("a", { href }, `Compare ${a.name} with ${b.name}`)];
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
      for (const [box] of this.boxes) box.addEventListener("change", () => this.chooseColumns());
      this.table.addEventListener("change", ({ target }) => {
        if (target.matches(".choose")) this.choose(target.closest("tr").id, target.checked);
      });
      this.reset.addEventListener("click", () => {
        this.change({ text: "", family: "", inputs: "", from: "", to: "" });
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
      const hidden = this.boxes.filter(([box]) => !box.checked).map(([box]) => box.value);
      const sort = hidden.includes(this.state.sort.key) ? SORTED_BY_RANK : this.state.sort;
      this.change({ hidden, sort });
    }

    choose(slug, isChosen) {
      const others = this.state.chosen.filter((other) => other !== slug);
      this.state.chosen = isChosen ? [...others.slice(-1), slug] : others;
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

  const place = document.querySelector(".controls");
  if (place && window.DataTable) new Board(document.querySelector("table.board"), place);
})();
