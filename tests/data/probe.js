// Put before everything else in a copy of a report: uses the page as a person would, and leaves what was seen in the document.
"use strict";
{
  const seen = { errors: [], moments: {}, figures: [] };
  const wrong = (text) => seen.errors.push(String(text));
  addEventListener("error", (event) => wrong(event.message), true);
  addEventListener("unhandledrejection", (event) => wrong(event.reason));
  addEventListener("securitypolicyviolation", (event) => wrong(`blocked: ${event.violatedDirective} ${event.blockedURI}`));
  for (const kind of ["error", "warn"]) console[kind] = (...said) => wrong(said.join(" "));

  // In Chromium's virtual time timers run and frames do not come: a frame every 16 ms, whatever the load of this computer.
  let clock = 0;
  setInterval(() => (clock += 16), 16);
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(clock), 16);

  // What stands in the side view now, and how large it is on the screen.
  const look = (name) => {
    const moving = [...document.querySelectorAll(".side [data-through], .side [data-at]")];
    const attributes = ["d", "cx", "cy"].map((key) => (element) => element.getAttribute(key) ?? "");
    const box = (selector) => document.querySelector(selector)?.getBoundingClientRect() ?? { width: 0, height: 0 };
    seen.moments[name] = {
      time: document.getElementById("now-time")?.textContent ?? "",
      linkage: moving.map((element) => attributes.map((of) => of(element)).join(" ")).join("|"),
      parts: moving.length,
      way: box("#done").width + box("#done").height,
      soil: document.getElementById("soil")?.getAttribute("d") ?? "",
      cursors: [...document.querySelectorAll("line.cursor")].map((line) => Number(line.getAttribute("x1"))),
      visible: [...document.querySelectorAll("line.cursor")].every((line) => line.getAttribute("visibility") !== "hidden"),
    };
  };
  const after = (ms) => new Promise((done) => setTimeout(done, ms));
  const use = async () => {
    const [play, slider] = ["play", "moment"].map((id) => document.getElementById(id));
    const move = (share) => {
      slider.value = Math.round(share * Number(slider.max));
      slider.dispatchEvent(new Event("input"));
    };
    // At the beginning a machine stands still.
    move(0.2);
    look("start");
    play.click();
    await after(600);
    look("playing");
    await after(600);
    look("later");
    play.click();
    look("paused");
    await after(300);
    look("still paused");
    move(0.8);
    look("moved");
    for (const figure of document.querySelectorAll("figure")) {
      const boxes = [...figure.querySelectorAll("polyline, rect")].map((line) => line.getBoundingClientRect());
      seen.figures.push({
        title: figure.previousElementSibling.textContent,
        lines: boxes.filter((box) => box.width > 20 && box.height > 2).length,
        points: Math.max(0, ...[...figure.querySelectorAll("polyline")].map((line) => line.points.length)),
      });
    }
  };
  addEventListener("load", () =>
    use()
      .catch(wrong)
      .finally(() => {
        const report = document.createElement("script");
        report.id = "probe";
        report.type = "application/json";
        report.textContent = JSON.stringify(seen).replaceAll("<", "\\u003c");
        document.body.append(report);
      }),
  );
}
