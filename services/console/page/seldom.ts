// These parts of the page are opened seldom: they are bundled together, and loaded when the first of them is opened.
export { Wall } from './home/wall';
export { ShapeView } from './map/map';
export { SiteView } from './map/site';
export { NetworkPage } from './network/network';
export { Cameras } from './robot/cameras';
export { Teach, Teaching } from './robot/teach';
export { Routes } from './routes/routes';
export { History } from './runs/history';
export { Schedules } from './schedules/schedules';
export { Users } from './users';
