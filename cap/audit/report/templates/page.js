// Show the claims that contain all words of the search, with a verdict that is ticked.
const search = document.querySelector("input[type=search]");
const boxes = [...document.querySelectorAll("nav input[type=checkbox]")];
const articles = [...document.querySelectorAll("article")].map((node) => [node, node.textContent.toLowerCase()]);
const shown = document.querySelector("#shown");

function update() {
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  const verdicts = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
  let count = 0;
  for (const [node, text] of articles) {
    const visible = verdicts.has(node.dataset.verdict) && words.every((word) => text.includes(word));
    node.classList.toggle("hidden", !visible);
    count += visible;
  }
  for (const section of document.querySelectorAll("section.claims")) {
    section.classList.toggle("hidden", !section.querySelector("article:not(.hidden)"));
  }
  shown.textContent = `${count} of ${articles.length}`;
}

function open() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target && target.classList.contains("hidden")) {
    search.value = "";
    boxes.forEach((box) => (box.checked = true));
    update();
    target.scrollIntoView();
  }
}

search.addEventListener("input", update);
boxes.forEach((box) => box.addEventListener("change", update));
addEventListener("hashchange", open);
update();
open();
