// The mechanism of this page in space; where it cannot be drawn, the exploded view below is the picture.
function viewer(data, kept, signal) {
{% include "data.js" %}

let viewed = () => kept.view;
{% include "scripts.js" %}

{% include "clock.js" %}
const draw = spacePicture(document.getElementById("picture"));
function drawNow(time) { draw(time); }
const legendOf = legendIn(document.getElementById("legend"), shown, kept);
if (!shown.size || !document.querySelector("#picture canvas")) for (const name of ["legend", "controls"]) document.getElementById(name).hidden = true;
if (!Object.values(data.poses).some((pose) => pose.columns.some((column) => column.length > 1))) document.getElementById("controls").hidden = true;
show();
}
const data_ = JSON.parse(document.getElementById("data").textContent);
viewer(data_, { at: data_.at }, new AbortController().signal);
